"""How fast the Python module is, by the processor's time. Run by hand: timings are not asserted.

PYTHONPATH=build/release/python /usr/bin/python3 tests/benchmarks/python_speed.py
"""

import pathlib
import time

import numpy

import sonoglide

SCENES = pathlib.Path(__file__).parents[2] / "host_sim" / "scenes"


def best_rate(count, work, clock=time.process_time):
    """Of several times the best."""
    rates = []
    for _ in range(7):
        begin = clock()
        work()
        rates.append(count / (clock() - begin))
    return max(rates)


def tell(what, rate, unit):
    print(f"{what:44} {rate:12.4g} {unit}")


def units():
    scene = sonoglide.Scene(SCENES / "target_step_q31.toml")
    count = 1_000_000
    force = (2**29 + numpy.random.default_rng(1).normal(0.0, 1e6, count)).astype(numpy.int32)
    velocity = numpy.full(count, 2**28, numpy.int32)
    for arithmetic in ("q31", "q15", "float32", "float64"):
        step = sonoglide.Unit(scene, arithmetic).step

        def single_steps():
            for _ in range(100_000):
                step(2**29, 2**28)

        tell(f"Unit.step, {arithmetic}", best_rate(100_000, single_steps), "steps/s")
        unit = sonoglide.Unit(scene, arithmetic)
        tell(f"Unit.steps, {arithmetic}", best_rate(count, lambda: unit.steps(force, velocity)), "steps/s")


def loops():
    scene = sonoglide.Scene(SCENES / "target_step_q31.toml")
    loop = sonoglide.Loop(scene)

    def episode():
        loop.reset()
        for _ in range(360):
            loop.step()

    tell("Loop.step, q31", best_rate(360, episode), "carrier periods/s")
    for tolerance, where in ((1e-10, "one by one"), (1e-6, "in lanes")):
        scenes = [scene.replace({"solver.tolerance": tolerance})] * 256
        rate = best_rate(256 * 360, lambda: sonoglide.rollout(scenes, threads=1))
        tell(f"rollout, q31, {where}, one thread", rate, "carrier periods/s")


units()
loops()
