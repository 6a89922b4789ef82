"""A controller in Python: a spring and a damper that bring the ring to the rotor.

  rotorub run SCENE.toml --controller tracking_law.py --set controller.config.stiffness=2e5
"""
import math


def create(setup):
    config = setup["config"]
    return {
        "stiffness": config.get("stiffness", 0.0),
        "damping": config.get("damping", 0.0),
        "gap_time": config.get("gap_time", 0.008),
        "clearance": setup["clearance"],
    }


def state_size(law):
    return 2  # begun, time of the first sample


def step(law, now, state):
    if state[0] == 0.0:
        state[0], state[1] = 1.0, now["t"]
    x, y = (now["rotor"][k] - now["stator"][k] for k in range(2))
    vx, vy = (now["rotor_velocity"][k] - now["stator_velocity"][k] for k in range(2))
    delta = math.hypot(x, y)
    if delta == 0.0:
        return 0.0, 0.0
    s = min((now["t"] - state[1]) / law["gap_time"], 1.0)
    wanted = law["clearance"] * (1.0 - s) ** 3 * (1.0 + 3.0 * s + 6.0 * s * s)
    error = law["clearance"] - delta - wanted
    rate = -(x * vx + y * vy) / delta
    push = law["stiffness"] * error + law["damping"] * rate
    return -push * x / delta, -push * y / delta
