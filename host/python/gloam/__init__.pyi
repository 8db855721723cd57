# Types of the module gloam. What each function takes and gives, with shapes and units, is in its docstring: help(gloam.run).
import os
from typing import Any, Dict, Iterator, List, Mapping, NamedTuple, Optional, Sequence as _Sequence, Tuple, Union

import numpy
import numpy.typing

Array = numpy.typing.NDArray[numpy.float32]
Plane = Union[Any, List[Any]]  # arrays of NumPy, or of any library that shares the host's memory by DLPack or __array__
Path = Union[str, "os.PathLike[str]"]
Point = Union[Tuple[float, float, float], List[float]]
Setting = Union[float, bool, str]
Image = Union[Any, "Frame", Mapping[str, Plane], Path]

__version__: str

class Error(RuntimeError): ...
class UsageError(Error, ValueError): ...

class MissingPlanes(Error):
    planes: List[str]

class Note(UserWarning): ...

class Camera:
    def __init__(self, fx: float, fy: float, cx: float, cy: float, *, orthographic: bool = False, near: Optional[float] = None,
                 far: Optional[float] = None, camera_to_world: Optional[numpy.typing.ArrayLike] = None,
                 world_to_camera: Optional[numpy.typing.ArrayLike] = None) -> None: ...
    @staticmethod
    def from_projection(projection: numpy.typing.ArrayLike, convention: str, width: int, height: int, *,
                        camera_to_world: Optional[numpy.typing.ArrayLike] = None,
                        world_to_camera: Optional[numpy.typing.ArrayLike] = None) -> "Camera": ...
    @staticmethod
    def from_intrinsics(K: numpy.typing.ArrayLike, *, pixel_centre: float = 0.5, near: Optional[float] = None, far: Optional[float] = None,
                        camera_to_world: Optional[numpy.typing.ArrayLike] = None,
                        world_to_camera: Optional[numpy.typing.ArrayLike] = None) -> "Camera": ...
    @staticmethod
    def from_fov(degrees: float, width: int, height: int, *, axis: str = "horizontal", near: Optional[float] = None,
                 far: Optional[float] = None, camera_to_world: Optional[numpy.typing.ArrayLike] = None,
                 world_to_camera: Optional[numpy.typing.ArrayLike] = None) -> "Camera": ...
    @property
    def fx(self) -> float: ...
    @property
    def fy(self) -> float: ...
    @property
    def cx(self) -> float: ...
    @property
    def cy(self) -> float: ...
    @property
    def orthographic(self) -> bool: ...
    @property
    def near(self) -> Optional[float]: ...
    @property
    def far(self) -> Optional[float]: ...
    @property
    def camera_to_world(self) -> Optional[numpy.typing.NDArray[numpy.float64]]: ...
    @property
    def source(self) -> str: ...

class DeviceInfo:
    @property
    def platform(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def type(self) -> str: ...
    @property
    def driver(self) -> str: ...
    @property
    def lanes(self) -> int: ...
    @property
    def has_double(self) -> bool: ...
    @property
    def memory(self) -> int: ...
    @property
    def largest_buffer(self) -> int: ...

class Device(DeviceInfo):
    def __init__(self, text: str = "", queue: Any = None) -> None: ...

class DeviceLayout(NamedTuple):
    pitch: int
    offset: int
    bytes: int

class DevicePlane(NamedTuple):
    memory: Any
    offset: int = 0
    pitch: int = 0
    step: int = 0
    is_clean: bool = False

class Enqueued:
    @property
    def int_ptr(self) -> int: ...
    @property
    def copied(self) -> List[str]: ...
    @property
    def device_bytes(self) -> int: ...
    def wait(self) -> None: ...

class Frame:
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def picture(self) -> Tuple[slice, slice]: ...
    @property
    def name(self) -> str: ...
    @property
    def views(self) -> List[str]: ...
    @property
    def planes(self) -> List[str]: ...
    @property
    def camera(self) -> Union[Camera, None, List[Optional[Camera]]]: ...
    @property
    def notes(self) -> List[str]: ...
    @property
    def attributes(self) -> Dict[str, str]: ...
    @property
    def numbers(self) -> Dict[str, float]: ...
    def keys(self) -> List[str]: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def __contains__(self, plane: str) -> bool: ...
    def __getitem__(self, plane: str) -> Any: ...

class Pass(NamedTuple):
    view: str
    name: str
    ms: List[float]

class Result(Dict[str, Any]):
    technique: str
    device: str
    lanes: int
    views: List[str]
    passes: List[Pass]
    total_ms: List[float]
    radius: Optional[float]
    radius_from: Optional[str]
    notes: List[str]
    attributes: Dict[str, str]
    skipped_share: float
    device_bytes: int
    frame: Frame
    number: Optional[int]
    @property
    def ms(self) -> float: ...
    @property
    def radius_pixels(self) -> Optional[float]: ...

class AutoResult(Result):
    effects: List[Dict[str, Any]]
    facts: Dict[str, Any]
    composite: Optional[Plane]

class Run(Iterator[Result]):
    def __next__(self) -> Result: ...

class Sequence:
    notes: List[str]
    def __init__(self, pattern: Union[Path, _Sequence[Path]], *, frames: Union[str, int, _Sequence[int], None] = None,
                 missing: Optional[str] = None, camera: Union[Camera, Path, None] = None, fov: Optional[float] = None,
                 depth_is: Optional[str] = None, depth: Optional[str] = None, near: Optional[float] = None, far: Optional[float] = None,
                 background: Optional[float] = None, depth_scale: Optional[float] = None, depth_offset: Optional[float] = None,
                 depth_bytes: Optional[str] = None, depth_encoding: Optional[str] = None, plane_files: Optional[Dict[str, Path]] = None, normals_are: Optional[str] = None, normal_space: Optional[str] = None, normal_range: Optional[str] = None,
                 normal_axes: Optional[str] = None, views: Union[str, List[str], None] = None,
                 channels: Optional[Dict[str, str]] = None) -> None: ...
    @property
    def numbers(self) -> List[int]: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[Frame]: ...
    def __getitem__(self, number: int) -> Frame: ...
    def read(self, number: int, planes: Union[str, List[str], None] = None) -> Frame: ...
    def run(self, technique: str, *, temporal: bool = False, device: Union[Device, str, None] = None,
            settings: Optional[Dict[str, Setting]] = None, **keywords: Any) -> Run: ...
    def write(self, technique: str, path: Path, *, temporal: bool = False, resume: bool = False, half: bool = True, compression: str = "zip",
              keep_depth: bool = False, keep_margin: bool = False, device: Union[Device, str, None] = None, settings: Optional[Dict[str, Setting]] = None,
              **keywords: Any) -> Written: ...

class Written(NamedTuple):
    done: List[int]
    skipped: List[int]
    again: Dict[int, str]

class Scene:
    def __init__(self, name: Path, **settings: Setting) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def faces(self) -> int: ...
    @property
    def cameras(self) -> List[str]: ...
    @property
    def ao_radius(self) -> Optional[float]: ...
    @property
    def notes(self) -> List[str]: ...

class Parameter(NamedTuple):
    name: str
    type: str
    default: Union[Setting, None]
    min: Optional[float]
    max: Optional[float]
    choices: List[str]
    unit: str
    help: str

class Technique:
    name: str
    summary: str
    paper: str
    reads: List[str]
    optional: List[str]
    writes: List[str]
    outputs: List[str]
    extras: List[str]
    then: str
    views: int
    caution: str
    parameters: Dict[str, Parameter]
    presets: Dict[str, Dict[str, str]]
    variant: Optional[Dict[str, str]]

def run(technique: str, frame: Union[Frame, Path, _Sequence[Path], None] = None, *, camera: Union[Camera, List[Camera], Path, None] = None,
        fov: Optional[float] = None, views: Union[str, List[str], None] = None, device: Union[Device, str, None] = None,
        settings: Optional[Dict[str, Setting]] = None, depth_is: Optional[str] = None, near: Optional[float] = None,
        far: Optional[float] = None, background: Optional[float] = None, depth_scale: Optional[float] = None, depth_offset: Optional[float] = None, normals_are: Optional[str] = None,
        normal_space: Optional[str] = None, normal_range: Optional[str] = None, normal_axes: Optional[str] = None, **keywords: Any) -> Result: ...
def device_layout(width: int, height: int) -> DeviceLayout: ...
def enqueue(technique: str, planes: Dict[str, Union[DevicePlane, List[DevicePlane]]],
            results: Dict[str, Union[DevicePlane, List[Optional[DevicePlane]]]], *,
            size: Tuple[int, int], camera: Union[Camera, List[Camera]], device: Device, wait_for: _Sequence[Any] = (),
            settings: Optional[Dict[str, Setting]] = None, **keywords: Any) -> Enqueued: ...
def auto(frame: Union[Frame, Path, _Sequence[Path], None] = None, *, budget: Union[float, str, None] = None, error: Optional[float] = None,
         mask: Optional[str] = None, measure: bool = False, composite: bool = False, color_holds: Optional[str] = None,
         ambient: Optional[Point] = None, camera: Union[Camera, List[Camera], Path, None] = None, fov: Optional[float] = None,
         views: Union[str, List[str], None] = None, device: Union[Device, str, None] = None,
         settings: Optional[Dict[str, Setting]] = None, depth_is: Optional[str] = None, near: Optional[float] = None,
         far: Optional[float] = None, background: Optional[float] = None, depth_scale: Optional[float] = None, depth_offset: Optional[float] = None, normals_are: Optional[str] = None,
         normal_space: Optional[str] = None, normal_range: Optional[str] = None, normal_axes: Optional[str] = None, **keywords: Any) -> AutoResult: ...
def pick(frame: Union[Frame, Path, None] = None, *, budget: Union[float, str, None] = None, error: Optional[float] = None, by: str = "rmse",
         truth: Union[Frame, Path, _Sequence[Union[Frame, Path]], None] = None, techniques: Union[str, List[str], None] = None,
         radius: Optional[float] = None, rays: int = 256, rounds: int = 9, time: Optional[float] = 60,
         device: Union[Device, str, None] = None, **reading: Any) -> Dict[str, Any]: ...
def read(file: Union[Path, _Sequence[Path]], *, camera: Union[Camera, Path, None] = None, fov: Optional[float] = None,
         depth_is: Optional[str] = None, depth: Optional[str] = None, near: Optional[float] = None, far: Optional[float] = None,
         background: Optional[float] = None, depth_scale: Optional[float] = None, depth_offset: Optional[float] = None,
                 depth_bytes: Optional[str] = None, depth_encoding: Optional[str] = None, plane_files: Optional[Dict[str, Path]] = None, normals_are: Optional[str] = None, normal_space: Optional[str] = None, normal_range: Optional[str] = None, normal_axes: Optional[str] = None,
         views: Union[str, List[str], None] = None, channels: Optional[Dict[str, str]] = None,
         planes: Union[str, List[str], None] = None, as_stored: bool = False) -> Frame: ...
def write(path: Path, what: Union[Frame, Result, Mapping[str, Plane], Any], *, plane: Optional[str] = None, camera: Union[Camera, List[Camera], None] = None,
          fov: Optional[float] = None, compression: str = "zip", half: bool = False, keep_margin: bool = False) -> None: ...
def compare(test: Image, reference: Image, *, plane: Optional[str] = None, mask: Optional[numpy.typing.NDArray[Any]] = None,
            frame: Union[Frame, Path, None] = None, exposure: Optional[float] = None) -> Dict[str, Any]: ...
def scenes() -> Dict[str, str]: ...
def capture(scene: Union[Scene, Path], width: int = 1920, height: int = 1080, planes: Union[str, List[str], None] = None, *,
            camera: Union[Camera, str, None] = None, eye: Optional[Point] = None, target: Optional[Point] = None,
            fov: Optional[float] = None, peel: int = 0, peel_light: bool = False, margin: Union[int, Tuple[int, int]] = 0, stochastic: int = 0, stereo: Optional[float] = None,
            convergence: Optional[float] = None, **settings: Setting) -> Frame: ...
def reference(frame: Union[Frame, Path], scene: Union[Scene, Path, None] = None, *, samples: Optional[int] = None,
              radius: Optional[float] = None, what: str = "ao", falloff: str = "none", bounces: Optional[int] = None,
              length: Optional[float] = None, light_direction: Optional[Point] = None,
              light_position: Optional[Point] = None, light_angle: Optional[float] = None, environment: Optional[Path] = None,
              environment_axes: Optional[str] = None, environment_turn: Optional[float] = None, color_holds: Optional[str] = None,
              ambient: Optional[Point] = None, seed: int = 0, checkpoint: Optional[Path] = None,
              settings: Optional[Dict[str, Setting]] = None, **scene_settings: Setting) -> Frame: ...
def techniques() -> Dict[str, Technique]: ...
def devices() -> List[DeviceInfo]: ...
