"""`atrium`: a court between two storeys of arcades, open to the sky, in the manner of the Sponza palace."""

from . import atrium_architecture as build
from . import atrium_furnishing as furnish
from . import textures
from .atrium_plan import (ARCADE, EAVES, HALL_X, HALL_Z, LOWER_CEILING, LOWER_SPRING, UPPER_CEILING,
                          UPPER_FLOOR, UPPER_SPRING, bays, columns, corners, spans)
from .gltf import Gltf
from .vector import about_axis, looking_along

_SUN_WAY, _SUN, _SUN_COLOUR = (0.40, -1.0, 0.26), 9.0, (1.0, 0.90, 0.74)
_EYE, _TARGET, _VFOV = (-9.4, 2.1, -2.5), (3.0, 3.5, 1.3), 58.0


def _materials(gltf):
    stone = gltf.texture("atrium/stone.png", textures.stone(256))
    ashlar = textures.Ashlar(512)
    marble = textures.MarbleFloor(512)
    bronze = textures.Bronze(256)
    damask = gltf.texture("atrium/damask.png", textures.damask(256))

    def cloth(name, colour):
        return gltf.material(name, colour, roughness=0.92, colour_texture=damask, double_sided=True)

    return {
        "stone": gltf.material("stone", colour_texture=stone, roughness=0.9),
        "ashlar": gltf.material("ashlar", roughness=0.95,
                                colour_texture=gltf.texture("atrium/ashlar.png", ashlar.colour()),
                                normal_texture=gltf.texture("atrium/ashlar_normal.png", ashlar.normals())),
        "plaster": gltf.material("plaster", (1.0, 0.77, 0.55), colour_texture=stone, roughness=1.0),
        "marble": gltf.material("marble", colour_texture=gltf.texture("atrium/marble.png", marble.colour()),
                                surface_texture=gltf.texture("atrium/marble_surface.png", marble.surface()),
                                normal_texture=gltf.texture("atrium/marble_normal.png", marble.normals())),
        "terracotta": gltf.material("terracotta", roughness=0.9,
                                    colour_texture=gltf.texture("atrium/terracotta.png", textures.terracotta(256))),
        "wood": gltf.material("wood", roughness=0.7,
                              colour_texture=gltf.texture("atrium/wood.png", textures.wood(256))),
        "red": cloth("red_cloth", (0.62, 0.035, 0.03)),
        "green": cloth("green_cloth", (0.04, 0.36, 0.07)),
        "blue": cloth("blue_cloth", (0.035, 0.09, 0.55)),
        "gold": cloth("golden_hem", (0.72, 0.47, 0.12)),
        "lattice": gltf.material("iron_lattice", metallic=0.0, roughness=0.55, alpha_cutoff=0.5, double_sided=True,
                                 colour_texture=gltf.texture("atrium/lattice.png", textures.lattice(128))),
        "frond": gltf.material("frond", roughness=0.6, alpha_cutoff=0.5, double_sided=True,
                               colour_texture=gltf.texture("atrium/frond.png", textures.frond(128, 256), clamp=True)),
        "iron": gltf.material("iron", (0.10, 0.09, 0.085), metallic=0.0, roughness=0.45),
        "clay": gltf.material("clay", (0.45, 0.20, 0.10), roughness=0.95),
        "soil": gltf.material("soil", (0.05, 0.035, 0.025)),
        "bronze": gltf.material("bronze", metallic=1.0,
                                colour_texture=gltf.texture("atrium/bronze.png", bronze.colour()),
                                surface_texture=gltf.texture("atrium/bronze_surface.png", bronze.surface())),
        "brass": gltf.material("brass", (0.89, 0.66, 0.30), metallic=1.0, roughness=0.22),
        "water": gltf.material("water", (0.02, 0.045, 0.045), roughness=0.06),
    }


def _turn(degrees):
    return about_axis((0, 1, 0), degrees) if degrees else None


def _masonry(gltf, material):
    whole = [("outer_walls", build.outer_walls(), "plaster"), ("dado", build.dado(), "ashlar"),
             ("cornices", build.cornices(), "stone"), ("court_floor", build.court_floor(), "marble"),
             ("gallery_floors", build.gallery_floors(), "terracotta"),
             ("ceilings", build.ceilings(), "wood"), ("roof", build.roof(), "terracotta")]
    for name, surface, key in whole:
        gltf.node(name, mesh=gltf.mesh(name, [(surface, material[key])]))

    frame, leaves = build.door()
    door = gltf.mesh("door", [(frame, material["stone"]), (leaves, material["wood"])])
    beam = gltf.mesh("beam", [(build.beam(), material["wood"])])
    storeys = (("lower", 0.0, LOWER_SPRING, UPPER_FLOOR, LOWER_CEILING, 0.285),
               ("upper", UPPER_FLOOR, UPPER_SPRING, EAVES, UPPER_CEILING, 0.25))
    for storey, foot, spring, top, ceiling, radius in storeys:
        column = gltf.mesh(storey + "_column", [(build.column(spring - foot, radius), material["stone"])])
        pier = gltf.mesh(storey + "_pier", [(build.pier(spring - foot, 0.66), material["stone"])])
        block = gltf.mesh(storey + "_corner", [(build.corner_block(spring, top), material["ashlar"])])
        pilaster = gltf.mesh(storey + "_pilaster", [(build.pilaster(ceiling - foot - 0.30), material["stone"])])
        arch = gltf.mesh(storey + "_arch", [(build.arch_wall(spring, top), material["ashlar"]),
                                            (build.arch_moulding(spring), material["stone"])])
        for x, z in columns():
            gltf.node(storey + "_column", mesh=column, translation=(x, foot, z))
        for x, z in corners():
            gltf.node(storey + "_pier", mesh=pier, translation=(x, foot, z))
            gltf.node(storey + "_corner", mesh=block, translation=(x, 0, z))
        for (x, z), turn in bays():
            gltf.node(storey + "_arch", mesh=arch, translation=(x, 0, z), rotation=_turn(turn))
        for x, z, turn in spans():
            toward = ARCADE / 2
            across = {0.0: (x, z + toward), 180.0: (x, z - toward), 90.0: (x + toward, z), -90.0: (x - toward, z)}[turn]
            wall = {0.0: (x, HALL_Z), 180.0: (x, -HALL_Z), 90.0: (HALL_X, z), -90.0: (-HALL_X, z)}[turn]
            gltf.node(storey + "_beam", mesh=beam, translation=(across[0], ceiling, across[1]), rotation=_turn(turn))
            gltf.node(storey + "_pilaster", mesh=pilaster, translation=(wall[0], foot, wall[1]),
                      rotation=_turn(turn + 180))
        for x in (-9.0, -3.0, 3.0, 9.0):
            gltf.node(storey + "_door", mesh=door, translation=(x, foot, -HALL_Z + 0.06))
            gltf.node(storey + "_door", mesh=door, translation=(x, foot, HALL_Z - 0.06), rotation=_turn(180))
        gltf.node(storey + "_door", mesh=door, translation=(-HALL_X + 0.06, foot, 0), rotation=_turn(90))
        gltf.node(storey + "_door", mesh=door, translation=(HALL_X - 0.06, foot, 0), rotation=_turn(-90))


def _cloths(gltf, material):
    rod = gltf.mesh("curtain_rod", [(furnish.curtain_rod(2.36), material["brass"])])
    drop = LOWER_SPRING - 0.12 - 0.22
    cuts = [furnish.curtain(2.2, drop, 7 + k, 71 + k) for k in range(3)]
    over_rail = furnish.tapestry(1.5, 1.9)
    dyes = ("red", "green", "blue")

    def dyed(kind, dye, parts):
        return gltf.mesh(kind + "_" + dye, [(parts[0], material[dye]), (parts[1], material["gold"])])

    curtains = [dyed("curtain", dye, cut) for dye, cut in zip(dyes, cuts)]
    tapestries = [dyed("tapestry", dye, over_rail) for dye in dyes]
    long_bays = bays()[:14]
    for k, ((x, z), turn) in enumerate(long_bays):
        side, bay = divmod(k, 7)
        if bay % 2 == 1:
            dye = (bay // 2 + 2 * side) % 3
            gltf.node("curtain_" + dyes[dye], mesh=curtains[dye], translation=(x, LOWER_SPRING - 0.12, z),
                      rotation=_turn(turn))
            gltf.node("curtain_rod", mesh=rod, translation=(x, LOWER_SPRING - 0.12, z))
        elif bay in (2, 4):
            dye = (bay // 2 + side) % 3
            toward = -1 if z > 0 else 1
            gltf.node("tapestry_" + dyes[dye], mesh=tapestries[dye],
                      translation=(x, UPPER_FLOOR + 0.99, z + toward * 0.10), rotation=_turn(turn))


def _furniture(gltf, material):
    lattice, rails = furnish.railing()
    railing = gltf.mesh("railing", [(lattice, material["lattice"]), (rails, material["iron"])])
    lamp = gltf.mesh("lamp", [(furnish.lamp(), material["brass"])])
    for k, ((x, z), turn) in enumerate(bays()):
        gltf.node("railing", mesh=railing, translation=(x, UPPER_FLOOR, z), rotation=_turn(turn))
        if k >= 14 or k % 7 % 2 == 0:
            gltf.node("lamp", mesh=lamp, translation=(x, LOWER_SPRING + 1.2, z))

    pedestal = gltf.mesh("pedestal", [(furnish.pedestal(), material["stone"])])
    vase = gltf.mesh("vase", [(furnish.vase(), material["bronze"])])
    for x in (-4.5, 4.5):
        for z in (-3.3, 3.3):
            gltf.node("pedestal", mesh=pedestal, translation=(x, 0, z))
            gltf.node("vase", mesh=vase, translation=(x, 0.92, z), rotation=_turn(35.0 if x * z > 0 else -35.0))

    clay, soil = furnish.pot()
    pot = gltf.mesh("pot", [(clay, material["clay"]), (soil, material["soil"])])
    plants = [gltf.mesh("plant", [(furnish.plant(81 + k, 18), material["frond"])]) for k in range(2)]
    places = [(x, z) for x in (-2.2, 2.2) for z in (-2.2, 2.2)] + [(x, z) for x in (-9.3, 9.3) for z in (-3.3, 3.3)]
    for k, (x, z) in enumerate(places):
        gltf.node("pot", mesh=pot, translation=(x, 0, z))
        gltf.node("plant", mesh=plants[k % 2], translation=(x, 0.54, z), rotation=_turn(67.0 * k))

    parts = furnish.fountain()
    fountain = gltf.mesh("fountain", [(parts[key], material[key]) for key in ("stone", "water", "bronze")])
    gltf.node("fountain", mesh=fountain)
    sphere = gltf.mesh("armillary_sphere", [(furnish.armillary_sphere(), material["brass"])])
    gltf.node("armillary_sphere", mesh=sphere, translation=(0, 2.34, 0))


def atrium():
    gltf = Gltf("atrium",
                "A court between two storeys of arcades, open to the sky: curtains in three colours, marble, bronze, "
                "plants; lit by the sun.")
    material = _materials(gltf)
    _masonry(gltf, material)
    _cloths(gltf, material)
    _furniture(gltf, material)
    way = tuple(t - e for t, e in zip(_TARGET, _EYE))
    gltf.camera("along the court", _EYE, looking_along(way), _VFOV, 16 / 9)
    gltf.directional("sun", looking_along(_SUN_WAY), _SUN, _SUN_COLOUR, position=(0, EAVES + 4, 0))
    return gltf
