#!/usr/bin/env python3
"""Measures the charts of this folder and renders the pictures of assets/readme again.

    assets/charts/make_charts.py [--program build/bounce] [NAME…]

Each chart is one `bounce chart`; its CSV, SVG and table (whose head says program, machine, driver and day) are kept. The
scenes beside the project are looked for as `bounce` does. Times are processor time, so that a busy machine does not matter.
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# Of each chart its runs, which are merged: a sweep is one of parameters that each graph of its run has.
CHARTS = {
    "lrsm": [["cornell", "sponza_sun", *graphs, "--resource", "out.indirect_diffuse", "--size", "160x90",
              "--noise", "0.05"]
             for graphs in (["--graphs", "lrsm,lrsm_tuned", "--sweep", "lrsm"], ["--graphs", "traced", "--sweep", "traced"])],
    "vf": [["cornell", *graphs, "--resource", "out.indirect_diffuse", "--size", "128x128", "--noise", "0.05"]
           for graphs in (["--graphs", "vf,vf_tuned", "--sweep", "vf"], ["--graphs", "ism_tuned", "--sweep", "ism"])],
    # Lists that are kept from growing: what does not fit is light that is lost.
    "vf_list_length": [["cornell", "--graphs", "vf_tuned", "--sweep", "vf_list_length", "--resource", "out.indirect_diffuse",
                        "--size", "128x128", "--noise", "0.05"]],
    "ldm_ao": [["cornell", *graphs, "--size", "128x128", "--noise", "0.02"]
               for graphs in (["--graphs", "ldm_ao,ldm_ao_tuned", "--sweep", "ldm_ao"],
                              ["--graphs", "traced_ao", "--sweep", "traced_ao"])],
    "occlusion_distance": [["cornell", "sponza", *graphs, "--resource", "out.ambient_occlusion_dmax", "--against", "d_max",
                            "--size", "128x128", "--noise", "0.02"]
                           for graphs in (["--graphs", "hbao,hbao_tuned", "--sweep", "occlusion_distance"],
                                          ["--graphs", "ldm_ao_tuned", "--sweep", "ldm_d_max"],
                                          ["--graphs", "traced_ao", "--sweep", "traced_d_max"])],
    "shadow_maps": [["cornell", "atrium", "--graphs", "direct", "--sweep", "shadow_maps", "--size", "160x90",
                     "--noise", "0.05"]],
}

PICTURES = {
    "atrium_lrsm.png": ["render", "atrium", "--graph", "lrsm_tuned", "--size", "640x360"],
    "atrium_reference.png": ["reference", "atrium", "--bounces", "1", "--spp", "256", "--size", "640x360"],
}


def run(program, arguments):
    environment = dict(os.environ, BOUNCE_CPU_TIME="1", BOUNCE_ROOT=str(ROOT))
    subprocess.run([program, *arguments], env=environment, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(ROOT / "build/bounce"))
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join([*CHARTS, *PICTURES])}; all without")
    options = parser.parse_args()
    for name in options.names:
        if name not in CHARTS and name not in PICTURES:
            parser.error(f"invalid name '{name}': expected one of {', '.join([*CHARTS, *PICTURES])}")
    for name in options.names or [*CHARTS, *PICTURES]:
        if name in PICTURES:
            run(options.program, [*PICTURES[name], "-o", str(ROOT / "assets/readme" / name)])
            continue
        with tempfile.TemporaryDirectory() as folder:
            parts = [f"{folder}/{i}" for i in range(len(CHARTS[name]))]
            for part, arguments in zip(parts, CHARTS[name]):
                run(options.program, ["chart", *arguments, "--warmup", "1", "--frames", "1", "-o", part])
            whole = parts[0]
            if len(parts) > 1:
                whole = f"{folder}/whole"
                first = CHARTS[name][0]
                against = ["--against", first[first.index("--against") + 1]] if "--against" in first else []
                run(options.program, ["chart", "--merge", *parts, *against, "-o", whole])
            for kind in ("csv", "svg"):
                shutil.copyfile(pathlib.Path(whole) / f"chart.{kind}", HERE / f"{name}.{kind}")


if __name__ == "__main__":
    main()
