"""A controller to begin with: the ring follows the rotor, by a spring and a damper between their centres.

Run it from this folder:

  rotorub run ../SCENE.toml --controller follow_law.py --set controller.sample_time=50us
"""

STIFFNESS = 4e5  # N/m
DAMPING = 400.0  # N s/m


def create(setup):
    return None


def step(law, now, state):
    """The force on the ring along x and y, N."""
    return tuple(
        STIFFNESS * (now["rotor"][axis] - now["stator"][axis])
        + DAMPING * (now["rotor_velocity"][axis] - now["stator_velocity"][axis])
        for axis in range(2)
    )
