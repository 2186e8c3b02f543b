#pragma once
// The limits that graphs are held to: the driver's, or smaller ones that are pretended, so that a graph made on a large
// driver can be tried on the smallest that OpenGL 4.6 allows.

#include <cstdint>
#include <glad/gl.h>
#include <string>
#include <string_view>
#include <vector>

namespace bounce {

struct DriverLimit {
    GLenum name = 0;
    const char* text = "";  ///< "GL_MAX_TEXTURE_SIZE"
    int64_t minimum = 0;    ///< what OpenGL 4.6 asks of every driver (tables 23.53 to 23.73)
    bool is_needed = false; ///< the program does not start with less
};
/// Every limit that is looked at.
const std::vector<DriverLimit>& driver_limits();
/// "GL_MAX_TEXTURE_SIZE"; of one that is not in the table its number.
std::string limit_name(GLenum name);

/// A limit of the present driver, or the pretended one if that is smaller. `axis`: of GL_MAX_COMPUTE_WORK_GROUP_COUNT
/// and _SIZE. Without a driver there are only pretended ones: graphs are also planned where no context is. Throws Error
/// when BOUNCE_LIMITS is malformed.
int64_t driver_limit(GLenum name, int axis = 0);
/// What the driver itself allows; 2⁶³ − 1 without one.
int64_t true_limit(GLenum name, int axis = 0);

/// From here on limits are at most these: "minimum" for all that OpenGL 4.6 allows drivers to have, or
/// "GL_MAX_IMAGE_UNITS=4,…", or both, where what is named has that limit instead of the minimum; empty: the driver's
/// own. BOUNCE_LIMITS in the environment says the same from the start. "minimum" also leaves out what a driver of 4.6
/// need not have: gl_Layer in vertex shaders. Throws Error.
void pretend_limits(const std::string& text);

/// Whether the driver has an extension that OpenGL 4.6 does not ask for; not with "minimum". Without a driver: true,
/// unless "minimum" is pretended.
bool driver_has(std::string_view extension);
/// Another context has become current: what was asked of the last one is forgotten.
void forget_driver();

} // namespace bounce
