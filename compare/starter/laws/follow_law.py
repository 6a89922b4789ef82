"""A controller to begin with: the ring follows the rotor, by a spring and a damper between their centres.

Its shim is compiled once, in this folder (Debian: python3-dev, pkg-config):

  cc -shared -fPIC -I . $(pkg-config --cflags python3-embed) python_controller.c -o python_controller.so \
    $(pkg-config --libs python3-embed)

and then

  rotorub run ../SCENE.toml --controller ./python_controller.so --set controller.sample_time=50us \
    --set controller.config.module=follow_law --set controller.config.path=.

The module has another name than follow.c, since Python would take follow.so for it.
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
