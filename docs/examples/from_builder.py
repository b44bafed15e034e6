from balloon_usd import RecipeBuilder, SimulationFailed, plan_recipe, simulate

recipe = (
    RecipeBuilder("bud", title="One short bubble")
    .balloon("main", size=260, color="green", length=0.06, tail=0.02)
    .bubbles(head=0.05)
    .rest("stem")
    .build()
)
frames = simulate(plan_recipe(recipe))
try:
    for frame in frames:
        print(f"{frame.time_code} of {frames.frame_count}: {frame.doing}, {frame.pressure.max():.0f} Pa")
except SimulationFailed as failed:
    print(failed.step, failed.time, failed.cause)
