// What help() says of the compiled classes and functions.
#pragma once

namespace gloam::python {

inline constexpr const char* camera_help = R"(A camera: intrinsics in pixels, and where it is.

A point (X, Y, -depth) of view space (right-handed, y up, looking along -z) lands at x = cx + fx * X / depth, y = cy - fy * Y / depth;
an orthographic camera does without the division. Pixel centres are at +0.5, row 0 is on top.

fx, fy: pixels per unit at depth 1 (orthographic: pixels per scene unit), above 0.  cx, cy: principal point, pixels.
near, far: clipping planes, scene units; depth at far is background.
camera_to_world, world_to_camera: a pose, (4, 4), a rotation and a translation in scene units; one of them, for techniques of several
views, for sequences and for scenes.
Raises gloam.Error for what is not finite, out of range or no rotation.)";

inline constexpr const char* from_projection_help =
    R"(The gloam.Camera of a renderer's projection matrix, (4, 4), perspective or orthographic, off-axis too.

projection: for column vectors (projection @ point); Unreal's for row vectors, as Unreal has it.
convention: "opengl": y up, z from -1 to 1 (reversed also 1 to 0), looking along -z.  "vulkan": y down, z from 0 to 1, looking along -z or +z; also
    Direct3D's once row 1 is negated.  "unreal": y up, z from 0 to 1, looking along +z. Reversed z and a far plane at infinity are read from the matrix.
width, height: of the image, pixels.  near and far of the camera, scene units, are those of the matrix, for depth_is="ndc" and "reversed".
camera_to_world, world_to_camera: a pose, (4, 4), for column vectors, with the axes of the view space that the matrix is for.
Raises gloam.UsageError for a matrix that is transposed, contains a view, mirrors the image, or is of another convention where that shows.)";

inline constexpr const char* from_intrinsics_help =
    R"(The gloam.Camera of a matrix of intrinsics, (3, 3): [[fx, 0, cx], [0, fy, cy], [0, 0, 1]], pixels.

pixel_centre: where K has the middle of the first pixel: 0.5 as gloam, COLMAP and renderers, 0 as OpenCV's calibration.
near, far, camera_to_world, world_to_camera: as for gloam.Camera. A pose of OpenCV, whose y is down and z ahead, is
camera_to_world @ numpy.diag([1, -1, -1, 1]) here.
Raises gloam.UsageError for a skew, and for a matrix that is transposed.)";

inline constexpr const char* from_fov_help =
    R"(The gloam.Camera of a field of view: square pixels, the principal point in the middle of the image.

degrees: 1 to 179, along the axis "horizontal" or "vertical".  width, height: of the image, pixels.
near, far, camera_to_world, world_to_camera: as for gloam.Camera.
Raises gloam.UsageError for an angle or a size out of range.)";

inline constexpr const char* device_help = R"(An OpenCL device, open, with its compiled kernels.

text: part of the platform's or the device's name, in any case; empty: the first GPU, else the widest CPU. Without a device, calls open the one
that their `device` text stands for at its first use, and keep it. Threads may share a device: their work on it runs one after another; devices
of their own run side by side.
queue: instead of a text, a command queue of pyopencl, or its address: the device works on that queue, with its context, for gloam.enqueue.
Raises gloam.Error, with a list of the devices, if none matches.)";

inline constexpr const char* enqueued_help =
    R"(What gloam.enqueue has enqueued. wait(): until the results are whole.  int_ptr: the address of the event that then is complete, for
pyopencl.Event.from_int_ptr or another queue's wait list; it lives as long as this object.
copied: names of planes that were copied on the device; the others are used in place.  device_bytes: allocated besides the caller's buffers.)";

inline constexpr const char* device_info_help =
    R"(What is known of a device: platform, name, type ("cpu", "gpu" or "other"), driver, lanes (pixels per work-item
that suit it), has_double, and memory and largest_buffer in bytes.)";

inline constexpr const char* frame_help =
    R"(Planes of one view or of several, with cameras, as gloam.read and gloam.capture make them. It does not change.

frame["depth"] is an array that cannot be written to: (height, width), in place, or (height, width, components), a copy. Of several views it is a
list of arrays, in the order of `views`. `planes` has the names, `notes` what was assumed, `attributes` and `numbers` what a file says of how
its planes were made. `picture` cuts an array to the display window, frame["depth"][frame.picture]: arrays of a frame that was rendered with a
margin, and of what is computed on it, have the margin too. Depth is in scene units, +inf on background; normals are unit, in view space.)";

inline constexpr const char* devices_help =
    R"(All devices of all platforms of OpenCL, a list of gloam.DeviceInfo. Opens none.
Raises gloam.Error if there is no platform.)";

}  // namespace gloam::python
