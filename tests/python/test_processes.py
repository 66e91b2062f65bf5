"""Threads, signals and processes."""

import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import facemap

POINTS = np.random.default_rng(7).uniform(-1, 2, (30_000, 3)).astype(np.float32)


def count_visible(view):
    return int(view.visible(POINTS).sum())


def count_of_scene(scene):
    return count_visible(facemap.View(scene, (0, 1, 3))), scene.render(width=64, height=64).png()


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_other_processes_give_the_same(bust, method):
    """With "fork" after this process has used its threads, which the child does not have."""
    view = facemap.View(bust, (0, 1, 3), 2)
    expected = count_visible(view), bust.render(width=64, height=64).png()
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.apply_async(count_visible, (view,)).get(60) == expected[0]
        assert pool.apply_async(count_of_scene, (bust,)).get(60) == expected


def test_a_view_of_before_the_fork_works_after_it(bust):
    view = facemap.View(bust, (0, 1, 3), 2)
    expected = count_visible(view)
    child = os.fork()
    if child == 0:
        os._exit(0 if count_visible(view) == expected else 1)
    assert _exit_code(child) == 0
    assert count_visible(view) == expected


def picture_of(scene):
    return scene.render(width=32, height=32)


def test_a_worker_gives_its_picture_back(bust):
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        frame = pool.apply_async(picture_of, (bust,)).get(60)
    assert frame.png() == picture_of(bust).png() and frame.depth.shape == (32, 32)


def _exit_code(child):
    end = time.monotonic() + 60
    while time.monotonic() < end:
        found, status = os.waitpid(child, os.WNOHANG)
        if found:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.02)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return "the child hangs"


LONG_CALLS = {
    "visibility": "facemap.visibility(scene, np.random.default_rng(1).uniform(-3, 3, (10**5, 3)), scene.vertices)",
    "render": "scene.render(width=8192, height=8192, samples=8, planes=[])",
}


@pytest.mark.parametrize("call", LONG_CALLS)
def test_an_interrupt_stops_a_long_call(call):
    program = textwrap.dedent(f"""
        import numpy as np, facemap
        scene = facemap.generate("bust")
        print("ready", flush=True)
        try:
            {LONG_CALLS[call]}
        except KeyboardInterrupt:
            print("interrupted", flush=True)
    """)
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    time.sleep(0.5)
    child.send_signal(signal.SIGINT)
    try:
        assert child.communicate(timeout=60)[0] == "interrupted\n"
    finally:
        child.kill()
    assert child.returncode == 0


def test_other_threads_go_on_meanwhile(bust):
    """One counts while the library works: it would get no turn if the interpreter's lock were held."""
    turns, is_done = [0], threading.Event()

    def count():
        while not is_done.is_set():
            turns[0] += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    before = turns[0]
    facemap.visibility(bust, np.random.default_rng(1).uniform(-3, 3, (30, 3)), bust.vertices)
    after = turns[0]
    is_done.set()
    counter.join()
    assert after > before


def test_threads_ask_one_view_together(bust):
    view = facemap.View(bust, (0, 1, 3), 2)
    expected = view.visible(POINTS)
    answers = [None] * 4

    def ask(i):
        answers[i] = view.visible(POINTS)

    threads = [threading.Thread(target=ask, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(answer, expected) for answer in answers)
