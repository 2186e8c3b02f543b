"""The measures that the atrium's parts share, in metres. x runs along the court, y up, z across; the origin is the
court's middle."""

BAY = 3.0                        # column to column
COURT_X, COURT_Z = 10.5, 4.5     # half the court, to the columns' axes: 7 by 3 bays
HALL_X, HALL_Z = 14.6, 8.6       # half the hall, to the inner faces of the outer walls
WALL = 0.4                       # thickness of the outer walls
ARCADE = 0.6                     # thickness of the arcades
OPENING = 1.2                    # radius of the arches

LOWER_SPRING, LOWER_CEILING, UPPER_FLOOR = 3.8, 5.3, 5.6
UPPER_SPRING, UPPER_CEILING, EAVES, TOP = 8.9, 10.9, 11.2, 12.0

STONE_TILE, ASHLAR_TILE, MARBLE_TILE, TERRACOTTA_TILE, WOOD_TILE, CLOTH_TILE = 2.0, 2.4, 2.0, 1.8, 1.2, 0.5


def long_side_columns():
    """x of the columns of a long side, corners included."""
    return [-COURT_X + BAY * k for k in range(8)]


def bays():
    """(position of the bay's middle on the arcade's axis, degrees about y that turn +z toward the court) of all
    twenty bays."""
    result = []
    for side, turn in ((1.0, 180.0), (-1.0, 0.0)):
        result += [((-COURT_X + BAY * (k + 0.5), side * COURT_Z), turn) for k in range(7)]
    for side, turn in ((1.0, -90.0), (-1.0, 90.0)):
        result += [((side * COURT_X, -COURT_Z + BAY * (k + 0.5)), turn) for k in range(3)]
    return result


def columns():
    """(x, z) of the sixteen round columns: all but the corners."""
    result = [(x, z) for z in (COURT_Z, -COURT_Z) for x in long_side_columns()[1:-1]]
    return result + [(x, z) for x in (COURT_X, -COURT_X) for z in (-BAY / 2, BAY / 2)]


def corners():
    return [(x, z) for x in (COURT_X, -COURT_X) for z in (COURT_Z, -COURT_Z)]


def spans():
    """(x, z, degrees about y that turn +z toward the wall) where a beam runs from the arcade to the outer wall."""
    result = [(x, z, 0.0 if z > 0 else 180.0) for z in (COURT_Z, -COURT_Z) for x in long_side_columns()]
    for x in (COURT_X, -COURT_X):
        result += [(x, -COURT_Z + BAY * k, 90.0 if x > 0 else -90.0) for k in range(4)]
    return result
