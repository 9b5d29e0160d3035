"""Computed torque in MuJoCo: the law by groebot's generated C code, compared with one by MuJoCo's own mass matrix and bias.

    python3 -m venv /tmp/mujoco && /tmp/mujoco/bin/pip install -r scripts/control/requirements.txt
    cargo build --release
    /tmp/mujoco/bin/python scripts/control/mujoco_loop.py > benches/record/YYYY-MM-DD-control.csv

The UR5 and Stanford arms of tests/corpus/dynamics follow q_i = 0.3 sin(2 pi 0.4 t + i) for 5 s. The initial error of each joint is 0.02 rad (m). The gains are
Kp = w^2 and Kv = 2 w with w = 20 rad/s. Each torque is constant for a step, which MuJoCo integrates by the Runge-Kutta method. `deviation` is the largest
deviation of the errors from 0.02 (1 + w t) exp(-w t). `later` is the largest error of the second half.
"""

import argparse
import ctypes
import subprocess
import sys
import tempfile
from pathlib import Path

import mujoco
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
CORPUS = ROOT / "tests/corpus/dynamics"
RATE = 2 * np.pi * 0.4
W = 20.0


def desired(t, count):
    phase = RATE * t + np.arange(count)
    return 0.3 * np.sin(phase), 0.3 * RATE * np.cos(phase), -0.3 * RATE**2 * np.sin(phase)


def printed(groebot, name, folder):
    """The generated inverse dynamics of a robot, as a function of numpy arrays."""
    source = Path(folder) / f"{name}_motion.c"
    subprocess.run([groebot, "dynamics", CORPUS / f"{name}.urdf", "--lang", "c", "--functions", "inverse", "-o", source], check=True)
    library = source.with_suffix(".so")
    subprocess.run(["cc", "-std=c99", "-O2", "-shared", "-fPIC", f"-I{ROOT / 'runtime/c'}", source, "-o", library, "-lm"], check=True)
    function = getattr(ctypes.CDLL(str(library)), f"{name}_inverse")
    pointer = ctypes.POINTER(ctypes.c_double)

    def inverse(q, v, a):
        lists = [np.ascontiguousarray(x, dtype=float) for x in (q, v, a)]
        out = np.zeros(len(q))
        function(*(x.ctypes.data_as(pointer) for x in (*lists, out)))
        return out

    return inverse


def model_of(name, step, factor=1.0):
    model = mujoco.MjModel.from_xml_path(str(CORPUS / f"{name}.urdf"))
    model.opt.timestep = step
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.gravity[:] = (0, 0, -9.81)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    model.body_mass[:] *= factor
    model.body_inertia[:] *= factor
    return model


def run(name, step, inverse, factor=1.0, delay=0, noise=(0.0, 0.0), duration=5.0):
    """Follows the trajectory. Returns the deviation from the ideal errors and the largest error of the second half."""
    plant, known = model_of(name, step, factor), model_of(name, step)
    data, seen = mujoco.MjData(plant), mujoco.MjData(known)
    count = plant.nv
    random = np.random.default_rng(1)
    q, v, _ = desired(0.0, count)
    data.qpos[:], data.qvel[:] = q + 0.02, v
    held, deviation, later = [], 0.0, 0.0
    steps = round(duration / step)
    for number in range(steps + 1):
        t = number * step
        qd, vd, ad = desired(t, count)
        error = data.qpos - qd
        deviation = max(deviation, np.abs(error - 0.02 * (1 + W * t) * np.exp(-W * t)).max())
        if number > steps // 2:
            later = max(later, np.abs(error).max())
        place = data.qpos + noise[0] * random.standard_normal(count)
        rate = data.qvel + noise[1] * random.standard_normal(count)
        change = ad - 2 * W * (rate - vd) - W**2 * (place - qd)
        if inverse is None:
            seen.qpos[:], seen.qvel[:] = place, rate
            mujoco.mj_forward(known, seen)
            mass = np.zeros((count, count))
            mujoco.mj_fullM(known, seen, mass)
            torque = mass @ change + seen.qfrc_bias
        else:
            torque = inverse(place, rate, change)
        held.append(torque)
        data.qfrc_applied[:] = held[max(number - delay, 0)]
        mujoco.mj_step(plant, data)
    return deviation, later


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--groebot", default=str(ROOT / "target/release/groebot"))
    groebot = arguments.parse_args().groebot
    print(f"# MuJoCo {mujoco.__version__}")
    print("robot,law,step_s,masses,delay_steps,noise_rad,deviation,later")
    with tempfile.TemporaryDirectory() as folder:
        for name in ("ur5", "stanford"):
            inverse = printed(groebot, name, folder)
            for step in (1e-3, 5e-4):
                for law, function in (("printed C", inverse), ("MuJoCo's M and bias", None)):
                    deviation, later = run(name, step, function)
                    print(f"{name},{law},{step},1,0,0,{deviation:.4e},{later:.4e}")
            for masses, delay, noise in ((1.05, 0, (0, 0)), (1.0, 1, (0, 0)), (1.0, 0, (1e-4, 1e-3))):
                for law, function in (("printed C", inverse), ("MuJoCo's M and bias", None)):
                    deviation, later = run(name, 1e-3, function, masses, delay, noise)
                    print(f"{name},{law},0.001,{masses},{delay},{noise[0]},{deviation:.4e},{later:.4e}")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
