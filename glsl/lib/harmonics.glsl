#ifndef LIB_HARMONICS_GLSL
#define LIB_HARMONICS_GLSL
// Real spherical harmonics of l = 0 and 1: Y_00 = k_y0, and Y_1x = k_y1·x along each axis. A lobe ⟨n·ω⟩⁺ has the coefficients
// c_00 = k_lobe0 and c_1m = k_lobe1·n_m, which make it ¼ + ½⟨n·ω⟩.

const float k_y0 = 0.282094791774, k_y1 = 0.488602511903; // √(1/4π), √(3/4π)
const float k_lobe0 = 0.886226925453, k_lobe1 = 1.023326707946; // √π/2, √(π/3)

#endif
