"""The files of the source tree, as the structure tests see it."""

import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def files(root=ROOT):
    """Paths relative to `root`, sorted: what git tracks or would track; in a tree without git, all but build folders."""
    listed = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            capture_output=True)
    if listed.returncode == 0:
        paths = [pathlib.Path(name) for name in listed.stdout.decode().split("\0") if name]
    else:
        paths = [path.relative_to(root) for path in root.rglob("*")]
        paths = [path for path in paths if not path.parts[0].startswith(("build", "bundle", ".git"))
                 and "__pycache__" not in path.parts]
    return sorted(path for path in set(paths) if (root / path).is_file())
