"""Expressions that a driver computes, one a row of a picture, so that drivers can be compared to the bit."""

import shutil

from drivers import ROOT, Picture

SHADER = """layout(local_size_x = 8, local_size_y = 8) in;
layout(FORMAT_probe_value) uniform writeonly image2D probe_value;
uint hashed(uint x) { x ^= x >> 16; x *= 0x7feb352du; x ^= x >> 15; x *= 0x846ca68bu; x ^= x >> 16; return x; }
float number(uint seed) { return float(hashed(seed) >> 8) / 4194304.0 - 2.0; }
void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    uint i = 3u * uint(at.x);
    float a = number(i), b = number(i + 1u), c = number(i + 2u), p = abs(a) + 0.01, r = 0.0;
    vec3 v = vec3(a, b, c), w = vec3(c, a, b + 0.5);
    mat3 m = mat3(v, w, vec3(c, 0.3, a));
    switch (at.y) {
CASES
    }
    imageStore(probe_value, at, vec4(r));
}
"""
# The words of a hash as numbers that a float holds: integer arithmetic has to be the same on every driver there is.
INTEGER = ["float(hashed(i) >> 8)", "float(hashed(i) % 1000u)", "float(int(hashed(i)) / 1024)", "float(bitCount(hashed(i)))",
           "float(findMSB(hashed(i)))", "float(bitfieldExtract(hashed(i), 3, 17))", "float(int(hashed(i)) >> 9)"]
ROUNDED = ["a + b", "a * b", "a * b + c", "a - b * c", "fma(a, b, c)", "a / b", "sqrt(p)", "cross(v, w).x", "mix(a, b, p)",
           "fract(17.0 * a)", "float(packHalf2x16(vec2(a, b)) >> 8)", "unpackHalf2x16(packHalf2x16(vec2(a, b))).x",
           "unpackUnorm4x8(packUnorm4x8(vec4(a, b, c, p))).w", "inverse(m)[0].x", "determinant(m)", "round(3.0 * a + 0.5)"]
MESA = ["inversesqrt(p)", "sin(a)", "cos(a)", "tan(0.5 * a)", "acos(0.5 * a)", "atan(a, b)", "exp2(a)", "log2(p)", "pow(p, 2.2)",
        "exp(a)", "log(p)", "mod(a, 0.3)", "smoothstep(-1.0, 1.0, a)"]
SUMS = ["dot(v, w)", "length(v)", "normalize(v).x", "distance(v, w)", "reflect(v, w).x", "(m * w).x"]
EXPRESSIONS = INTEGER + ROUNDED + MESA + SUMS
COUNT = 1024


def values(driver, root, expressions):
    """The bytes of COUNT floats by expression. `root`: an empty folder for the shader and its graph."""
    shutil.copytree(ROOT / "glsl", root / "glsl")
    (root / "assets/graphs").mkdir(parents=True)
    for name in ("scenes", "shots"):
        (root / "assets" / name).symlink_to(ROOT / "assets" / name)
    cases = "\n".join(f"    case {i}: r = {text}; break;" for i, text in enumerate(expressions))
    (root / "glsl/probe.comp").write_text(SHADER.replace("CASES", cases))
    (root / "assets/graphs/probe.json").write_text(
        f'{{"version": 1, "resources": {{"probe.value": {{"format": "rgba32f", "size": [{COUNT}, {len(expressions)}]}}}},'
        ' "passes": [{"id": "probe", "type": "compute", "shader": "probe.comp"}]}')
    picture = Picture(driver, "cornell", "probe", (8, 8), "--resource", "probe.value", root=root)
    return {text: picture.channels["R"][i * COUNT:(i + 1) * COUNT].tobytes() for i, text in enumerate(expressions)}
