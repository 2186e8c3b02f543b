#pragma once
// The headers of an OpenEXR file gone through before the library reads them: it takes memory by what attributes say of
// their sizes, whatever the file holds.

#include <string_view>

namespace bounce {

/// Throws Error unless every attribute of every header lies within the file and has the size of its type, as a list of
/// channels or a preview with so many pixels has (OpenEXR File Layout, 2.0: "Header", "Predefined Attributes"). Other
/// damage is left to the library.
void check_exr(std::string_view file);

} // namespace bounce
