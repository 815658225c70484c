"""The functions of libglidepath, and their failures as exceptions."""

import ctypes
import os

from . import _layout


class Error(Exception):
    """A function failed. `code` is an `ErrorCode`, the text says what to do."""

    def __init__(self, code, text):
        super().__init__(text)
        self.code = code


class Refused(Error):
    """The interpolator refused a command. `reply` is its answer."""

    reply = None


def _path():
    """GLIDEPATH_LIBRARY if that is set, else the one of the wheel, else where the system looks."""
    named = os.environ.get("GLIDEPATH_LIBRARY")
    if named:
        return named
    name = f"libglidepath.so.{_layout.ABI}"
    beside = os.path.join(os.path.dirname(__file__), name)
    return beside if os.path.exists(beside) else name


def _load():
    path = _path()
    try:
        return ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(
            f"{path}: {error}; build it with `cargo build --release -p glidepath-capi`, and set "
            "GLIDEPATH_LIBRARY to its path, or put it where the system looks for libraries"
        ) from error


_lib = _load()

_pointer = ctypes.c_void_p
_handle = ctypes.POINTER(ctypes.c_void_p)
_size = ctypes.c_size_t
_u32, _u64 = ctypes.c_uint32, ctypes.c_uint64

_FUNCTIONS = {
    "gp_abi_version": (_u32, []),
    "gp_layout": (_u64, []),
    "gp_version": (ctypes.c_char_p, []),
    "gp_now_ns": (_u64, []),
    "gp_last_error": (_size, [ctypes.c_char_p, _size]),
    "gp_state_text": (ctypes.c_int, [_u32, ctypes.c_char_p, _size]),
    "gp_fault_text": (ctypes.c_int, [_pointer, _size, ctypes.c_char_p, _size]),
    "gp_fault_remedy": (ctypes.c_int, [_pointer, _size, ctypes.c_char_p, _size]),
    "gp_open_as": (ctypes.c_int, [ctypes.c_char_p, _u32, _u64, _handle]),
    "gp_close": (ctypes.c_int, [_pointer]),
    "gp_read_status": (ctypes.c_int, [_pointer, _pointer, _size, _u32]),
    "gp_command": (
        ctypes.c_int,
        [_pointer, _u32, ctypes.c_double, _u32, _u32, _pointer, _size],
    ),
    "gp_acknowledge": (
        ctypes.c_int,
        [_pointer, _pointer, ctypes.c_int, _u32, _pointer, _size],
    ),
    "gp_setpoints_open": (ctypes.c_int, [_pointer, _handle]),
    "gp_next": (ctypes.c_int, [_pointer, _pointer, _size]),
    "gp_latest": (ctypes.c_int, [_pointer, _pointer, _size, ctypes.POINTER(_u64)]),
    "gp_setpoints_close": (ctypes.c_int, [_pointer]),
    "gp_feedback_open": (ctypes.c_int, [_pointer, _handle]),
    "gp_feedback_send": (ctypes.c_int, [_pointer, _pointer, _size]),
    "gp_feedback_close": (ctypes.c_int, [_pointer]),
    "gp_jog_open": (ctypes.c_int, [_pointer, _handle]),
    "gp_jog_send": (ctypes.c_int, [_pointer, _pointer, _size]),
    "gp_jog_is_followed": (ctypes.c_int, [_pointer, _pointer, _size]),
    "gp_jog_keep": (ctypes.c_int, [_pointer]),
    "gp_jog_close": (ctypes.c_int, [_pointer]),
    "gp_segments_open": (ctypes.c_int, [_pointer, _handle]),
    "gp_segments_send": (
        ctypes.c_int,
        [_pointer, _pointer, _size, _u32, _pointer, _size],
    ),
    "gp_segments_close": (ctypes.c_int, [_pointer]),
    "gp_servo_settings_default": (ctypes.c_int, [_pointer, _size]),
    "gp_servo_open": (ctypes.c_int, [_pointer, _pointer, _size, _handle]),
    "gp_servo_receive": (ctypes.c_int, [_pointer, _u64, _pointer, _size]),
    "gp_servo_demand": (ctypes.c_int, [_pointer, _u64, _pointer, _size]),
    "gp_servo_stop": (ctypes.c_int, [_pointer, _u64]),
    "gp_servo_rearm": (ctypes.c_int, [_pointer]),
    "gp_servo_rearm_at": (ctypes.c_int, [_pointer, _pointer, _pointer]),
    "gp_servo_read_state": (ctypes.c_int, [_pointer, _pointer, _size]),
    "gp_servo_release": (ctypes.c_int, [_pointer]),
    "gp_servo_close": (ctypes.c_int, [_pointer]),
}


def _declare():
    for name, (result, arguments) in _FUNCTIONS.items():
        function = getattr(_lib, name)
        function.restype, function.argtypes = result, arguments


def _compare():
    """Refuses a library of another ABI, and structures that are not as the library has them."""
    here = (_layout.ABI, _layout.LAYOUT)
    library = (_lib.gp_abi_version(), _lib.gp_layout())
    if library != here:
        raise ImportError(
            f"libglidepath has ABI {library[0]} ({library[1]:#x}), this package {here[0]} "
            f"({here[1]:#x}): use the package that came with the library"
        )
    for structure, (size, offsets) in _layout.PLACES.items():
        places = {name: getattr(structure, name).offset for name in offsets}
        if ctypes.sizeof(structure) != size or places != offsets:
            raise ImportError(f"{structure.__name__} has another layout in this Python")


_declare()
_compare()


def call(name, *arguments):
    """Calls a function that may fail; gives what it returns."""
    result = getattr(_lib, name)(*arguments)
    if isinstance(result, int) and result < 0:
        text = ctypes.create_string_buffer(513)
        _lib.gp_last_error(text, len(text))
        code = _layout.ErrorCode(result)
        kind = Refused if code == _layout.ErrorCode.REFUSED else Error
        raise kind(code, text.value.decode("utf-8", "replace"))
    return result


def text_of(name, *arguments):
    """Calls a function that gives a text."""
    size = call(name, *arguments, None, 0) + 1
    text = ctypes.create_string_buffer(size)
    call(name, *arguments, text, size)
    return text.value.decode()


def plain(name, *arguments):
    """Calls a function that cannot fail."""
    return getattr(_lib, name)(*arguments)
