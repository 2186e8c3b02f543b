/* The decoder of images, compiled with the fuzzers: what it reads or writes beside its tables shows only if it is
   instrumented itself. The program's own is the system's. */
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
