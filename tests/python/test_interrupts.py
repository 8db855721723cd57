"""Ctrl-C inside a call is a KeyboardInterrupt, soon, and nothing is lost."""

import os
import signal
import subprocess
import sys
import time

import pytest

START = """
import signal, sys, warnings
import gloam
warnings.simplefilter("ignore")
signal.signal(signal.SIGINT, signal.default_int_handler)
frame = gloam.capture("colonnade", 320, 180, ["normal"])
def goes_on():
    print("goes on", gloam.run("gtao", frame, radius=0.5)["ao"].shape, flush=True)
goes_on()
"""


def interrupted(text, seconds=0.7):
    """Runs a program, sends SIGINT after its line "begins", and returns its output."""
    process = subprocess.Popen([sys.executable, "-c", START + text], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=os.environ)
    lines = []
    for line in process.stdout:
        lines.append(line)
        if line.startswith("begins"):
            break
    time.sleep(seconds)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=500)
    assert process.returncode == 0, err
    return "".join(lines) + out


def test_reference_stops():
    # A row takes an hour: the program ends in time only if it stops within one.
    out = interrupted("""
try:
    print("begins", flush=True)
    gloam.reference(frame, samples=1 << 24)
except KeyboardInterrupt:
    print("interrupted", flush=True)
goes_on()
""")
    assert "interrupted\ngoes on" in out


def test_capture_stops():
    out = interrupted("""
try:
    print("begins", flush=True)
    while True:
        gloam.capture("hairball", 4000, 3000, peel=8)
except KeyboardInterrupt:
    print("interrupted", flush=True)
goes_on()
""", seconds=3)
    assert "interrupted\ngoes on" in out


def test_run_stops_between_passes():
    out = interrupted("""
try:
    print("begins", flush=True)
    gloam.run("evidence", frame, radius=0.5, preset="ultra", repeat=1000000)
except KeyboardInterrupt:
    print("interrupted", flush=True)
goes_on()
""")
    assert "interrupted\ngoes on" in out


def test_a_sequence_stops(tmp_path):
    out = interrupted(f"""
for i in range(1, 4):
    gloam.write("{tmp_path}/shot.000%d.exr" % i, frame)
sequence = gloam.Sequence("{tmp_path}/shot.####.exr")
try:
    print("begins", flush=True)
    while True:
        for result in sequence.run("evidence", radius=0.5, preset="ultra"):
            pass
except KeyboardInterrupt:
    print("interrupted", flush=True)
print(len(list(sequence.run("gtao", radius=0.5))))
goes_on()
""")
    assert "interrupted\n3\ngoes on" in out


def test_a_handler_of_ones_own_may_raise_what_it_likes():
    out = interrupted("""
class Enough(Exception):
    pass
def handler(number, frame):
    raise Enough("of it")
signal.signal(signal.SIGINT, handler)
try:
    print("begins", flush=True)
    gloam.reference(frame, samples=1 << 20)
except Enough as error:
    print("enough", error, flush=True)
goes_on()
""")
    assert "enough of it\ngoes on" in out
