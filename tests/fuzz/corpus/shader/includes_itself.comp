#include "input.comp"
#include "../input.comp"
#include "/etc/hostname"
#include "missing.glsl"
#include
