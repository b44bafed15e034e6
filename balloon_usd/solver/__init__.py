"""The solver room: plans made to happen to rubber and gas, on Warp; frames come out."""
