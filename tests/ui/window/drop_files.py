#!/usr/bin/env python3
"""drop_files.py WINDOW FILE...: drops files on the middle of an X11 window by XDND version 5 (text/uri-list), as a file
manager does. Fails unless the window confirms within ten seconds that it accepts them."""

import ctypes
import pathlib
import select
import sys
from ctypes import POINTER, byref, c_char_p, c_int, c_long, c_uint, c_ulong, c_void_p

ClientMessage, SelectionRequest, SelectionNotify = 33, 30, 31  # X.h
ReplaceMode, CurrentTime = 0, 0


class Message(ctypes.Structure):
    """XClientMessageEvent."""

    _fields_ = [("type", c_int), ("serial", c_ulong), ("send_event", c_int), ("display", c_void_p), ("window", c_ulong),
                ("message_type", c_ulong), ("format", c_int), ("data", c_long * 5)]


class Request(ctypes.Structure):
    """XSelectionRequestEvent."""

    _fields_ = [("type", c_int), ("serial", c_ulong), ("send_event", c_int), ("display", c_void_p), ("owner", c_ulong),
                ("requestor", c_ulong), ("selection", c_ulong), ("target", c_ulong), ("property", c_ulong),
                ("time", c_ulong)]


class Notice(ctypes.Structure):
    """XSelectionEvent."""

    _fields_ = [("type", c_int), ("serial", c_ulong), ("send_event", c_int), ("display", c_void_p),
                ("requestor", c_ulong), ("selection", c_ulong), ("target", c_ulong), ("property", c_ulong),
                ("time", c_ulong)]


class Event(ctypes.Union):
    """XEvent."""

    _fields_ = [("type", c_int), ("message", Message), ("request", Request), ("notice", Notice), ("pad", c_long * 24)]


def library():
    x = ctypes.CDLL("libX11.so.6")
    x.XOpenDisplay.restype = c_void_p
    x.XOpenDisplay.argtypes = [c_char_p]
    x.XDefaultRootWindow.restype = c_ulong
    x.XDefaultRootWindow.argtypes = [c_void_p]
    x.XInternAtom.restype = c_ulong
    x.XInternAtom.argtypes = [c_void_p, c_char_p, c_int]
    x.XCreateSimpleWindow.restype = c_ulong
    x.XCreateSimpleWindow.argtypes = [c_void_p, c_ulong, c_int, c_int, c_uint, c_uint, c_uint, c_ulong, c_ulong]
    x.XSetSelectionOwner.argtypes = [c_void_p, c_ulong, c_ulong, c_ulong]
    x.XChangeProperty.argtypes = [c_void_p, c_ulong, c_ulong, c_ulong, c_int, c_int, c_char_p, c_int]
    x.XSendEvent.argtypes = [c_void_p, c_ulong, c_int, c_long, POINTER(Event)]
    x.XTranslateCoordinates.argtypes = [c_void_p, c_ulong, c_ulong, c_int, c_int, POINTER(c_int), POINTER(c_int),
                                        POINTER(c_ulong)]
    x.XGetGeometry.argtypes = [c_void_p, c_ulong, POINTER(c_ulong), POINTER(c_int), POINTER(c_int), POINTER(c_uint),
                               POINTER(c_uint), POINTER(c_uint), POINTER(c_uint)]
    x.XNextEvent.argtypes = [c_void_p, POINTER(Event)]
    x.XPending.argtypes = [c_void_p]
    x.XFlush.argtypes = [c_void_p]
    x.XConnectionNumber.argtypes = [c_void_p]
    return x


class Source:
    """The source of the drag: a hidden window that owns XdndSelection."""

    def __init__(self, target, files):
        self.x = library()
        self.display = self.x.XOpenDisplay(None)
        if not self.display:
            sys.exit("no X11 display")
        self.target = target
        self.root = self.x.XDefaultRootWindow(self.display)
        self.window = self.x.XCreateSimpleWindow(self.display, self.root, 0, 0, 1, 1, 0, 0, 0)
        self.list = "".join(pathlib.Path(file).resolve().as_uri() + "\r\n" for file in files).encode()
        self.x.XSetSelectionOwner(self.display, self.atom("XdndSelection"), self.window, CurrentTime)

    def atom(self, name):
        return self.x.XInternAtom(self.display, name.encode(), 0)

    def send(self, name, *data):
        event = Event()
        event.message = Message(ClientMessage, 0, 1, self.display, self.target, self.atom(name), 32,
                                (c_long * 5)(self.window, *data))
        self.x.XSendEvent(self.display, self.target, 0, 0, byref(event))
        self.x.XFlush(self.display)

    def middle(self):
        """Returns the middle of the target in screen coordinates."""
        parent, x, y, width, height = c_ulong(), c_int(), c_int(), c_uint(), c_uint()
        self.x.XGetGeometry(self.display, self.target, byref(parent), byref(x), byref(y), byref(width), byref(height),
                            byref(c_uint()), byref(c_uint()))
        self.x.XTranslateCoordinates(self.display, self.target, self.root, width.value // 2, height.value // 2,
                                     byref(x), byref(y), byref(c_ulong()))
        return x.value, y.value

    def next_event(self):
        connection = self.x.XConnectionNumber(self.display)
        if not self.x.XPending(self.display) and not select.select([connection], [], [], 10)[0]:
            sys.exit("the window does not answer")
        event = Event()
        self.x.XNextEvent(self.display, byref(event))
        return event

    def answer(self, request):
        """Writes the file names to the property that the target requests."""
        self.x.XChangeProperty(self.display, request.requestor, request.property, request.target, 8, ReplaceMode,
                               self.list, len(self.list))
        event = Event()
        event.notice = Notice(SelectionNotify, 0, 1, self.display, request.requestor, request.selection,
                              request.target, request.property, request.time)
        self.x.XSendEvent(self.display, request.requestor, 0, 0, byref(event))
        self.x.XFlush(self.display)

    def drop(self):
        x, y = self.middle()
        self.send("XdndEnter", 5 << 24, self.atom("text/uri-list"))
        self.send("XdndPosition", 0, x << 16 | y, CurrentTime, self.atom("XdndActionCopy"))
        while True:
            event = self.next_event()
            if event.type == SelectionRequest:
                self.answer(event.request)
            elif event.type == ClientMessage and event.message.message_type == self.atom("XdndStatus"):
                if not event.message.data[1] & 1:
                    sys.exit("the window rejects the files")
                self.send("XdndDrop", 0, CurrentTime)
            elif event.type == ClientMessage and event.message.message_type == self.atom("XdndFinished"):
                return event.message.data[1] != 0  # GLFW sends the length of the list instead of bit 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    if not Source(int(sys.argv[1], 0), sys.argv[2:]).drop():
        sys.exit("the window has not accepted the files")
