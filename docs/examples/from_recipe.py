from balloon_usd import Recipe, draw_contact_sheet, plan_recipe, plan_text, simulate, write_stage

plan = plan_recipe(Recipe.load("recipes/dog.yaml"))
print(plan_text(plan))
written = write_stage(plan, simulate(plan, detail="draft", device="auto"), "out")
draw_contact_sheet(written.files[0], "out/dog.png")
