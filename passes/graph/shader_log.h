#pragma once

namespace bounce {

/// Whether shaders that do not compile are told in the log (so by default), and not only by Graph::problems(): not in
/// commands that end with them as their error anyway.
void set_shader_errors_logged(bool logged);
bool shader_errors_logged();

} // namespace bounce
