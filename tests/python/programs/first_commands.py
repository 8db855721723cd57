"""The first commands of somebody who has NumPy and a depth buffer. Run in an empty folder, by tests/python/test_first_commands.py and on a
fresh Debian by script/try-package."""
import numpy as np
import gloam

# What the user has: a wall with a box before it, as a list of rows in double, and the matrix and the depth buffer of an OpenGL program.
height, width, near, far = 90, 160, 0.1, 50.0
z = np.full((height, width), 5.0)
z[30:60, 50:110] = 4.5
f = 1 / np.tan(np.radians(40) / 2)
projection = np.array([[f * height / width, 0, 0, 0], [0, f, 0, 0], [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)], [0, 0, -1, 0]])
buffer = (far / (far - near) * (1 - near / z)).astype(np.float32)

camera = gloam.Camera.from_projection(projection, "opengl", width, height)
result = gloam.run("gtao", depth=z, camera=camera, radius=0.8)
gloam.write("ao.png", result["ao"])
again = gloam.run("gtao", depth=buffer[None], camera=camera, depth_is="ndc", radius=0.8)
figures = gloam.compare(again, result)

print(f"{result['ao'].shape} open {result['ao'][5, 5]:.2f} beside the box {result['ao'][45, 48]:.2f} rmse {figures['rmse']:.5f} notes {result.notes + again.notes}")
