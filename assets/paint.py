"""Materials of the meshes: metallic-roughness, linear colours."""

from typing import NamedTuple, Tuple


class Paint(NamedTuple):
    name: str
    color: Tuple[float, float, float]  # linear RGB
    roughness: float = 0.6
    metallic: float = 0.0
    opacity: float = 1.0


YELLOW = Paint("yellow_paint", (0.80, 0.36, 0.02), 0.38)
ORANGE = Paint("orange_paint", (0.62, 0.125, 0.010), 0.40)
WHITE = Paint("white_paint", (0.72, 0.72, 0.70), 0.40)
RED = Paint("red_paint", (0.50, 0.03, 0.02), 0.38)
BLUE = Paint("blue_paint", (0.03, 0.10, 0.30), 0.40)
CHARCOAL = Paint("charcoal_paint", (0.045, 0.047, 0.05), 0.50)
BLACK = Paint("black_plastic", (0.018, 0.018, 0.02), 0.60)
RUBBER = Paint("rubber", (0.022, 0.021, 0.020), 0.85)
STEEL = Paint("steel", (0.42, 0.42, 0.43), 0.42, 0.9)
WORN_STEEL = Paint("worn_steel", (0.33, 0.30, 0.27), 0.52, 0.75)
CHROME = Paint("chrome", (0.80, 0.81, 0.83), 0.12, 1.0)
GLASS = Paint("glass", (0.20, 0.27, 0.28), 0.06, 0.0, 0.25)
MIRROR = Paint("mirror", (0.75, 0.77, 0.80), 0.05, 1.0)
LAMP = Paint("lamp", (0.90, 0.90, 0.85), 0.15)
RED_LAMP = Paint("red_lamp", (0.55, 0.02, 0.02), 0.20)
BEACON = Paint("orange_beacon", (0.95, 0.30, 0.01), 0.20)
FABRIC = Paint("seat_fabric", (0.07, 0.07, 0.08), 0.95)
INTERIOR = Paint("interior_plastic", (0.16, 0.16, 0.165), 0.75)
HI_VIS = Paint("hi_vis_orange", (0.95, 0.22, 0.02), 0.85)
REFLECTIVE = Paint("reflective_tape", (0.78, 0.80, 0.78), 0.35)
TROUSERS = Paint("work_trousers", (0.035, 0.05, 0.09), 0.92)
SHIRT = Paint("shirt", (0.12, 0.16, 0.24), 0.92)
SKIN = Paint("skin", (0.55, 0.30, 0.20), 0.60)
LEATHER = Paint("boot_leather", (0.12, 0.07, 0.035), 0.70)
GLOVE = Paint("glove", (0.30, 0.26, 0.18), 0.90)
HELMET = Paint("helmet", (0.85, 0.62, 0.03), 0.30)
ROCK = Paint("rock", (0.27, 0.25, 0.225), 0.90)
CONE_ORANGE = Paint("cone_orange", (0.85, 0.13, 0.02), 0.55)
CONCRETE = Paint("concrete", (0.42, 0.41, 0.385), 0.92)
GALVANISED = Paint("galvanised_steel", (0.52, 0.54, 0.55), 0.45, 0.8)
BARK = Paint("bark", (0.11, 0.065, 0.04), 0.95)
FOLIAGE = Paint("foliage", (0.045, 0.11, 0.03), 0.90)
LIGHT_FOLIAGE = Paint("light_foliage", (0.075, 0.16, 0.04), 0.90)
WOOD = Paint("wood", (0.42, 0.28, 0.14), 0.85)
OLD_WOOD = Paint("weathered_wood", (0.22, 0.18, 0.14), 0.90)
PIPE_ORANGE = Paint("orange_pipe", (0.55, 0.16, 0.04), 0.45)
IRON = Paint("cast_iron", (0.10, 0.095, 0.09), 0.60, 0.6)
RUBBLE = Paint("broken_concrete", (0.26, 0.245, 0.22), 0.95)
PAPER = Paint("paper_bag", (0.46, 0.36, 0.24), 0.85)
RUST = Paint("rusty_steel", (0.20, 0.085, 0.04), 0.90, 0.3)
DRY_GRASS = Paint("dry_grass", (0.23, 0.20, 0.075), 0.92)
BLOCK = Paint("masonry_block", (0.36, 0.35, 0.33), 0.95)
