#pragma once
// Answers of a driver that is not here.

#include <glad/gl.h>
#include <string>

namespace bounce {

/// Puts another function in the place of one of OpenGL's until the end of its scope:
/// Fake told(glad_glGetError, +[]() -> GLenum { return GL_OUT_OF_MEMORY; });
template <class Function>
class Fake {
  public:
    Fake(Function& place, Function function) : place_(place), before_(place) { place_ = function; }
    ~Fake() { place_ = before_; }
    Fake(const Fake&) = delete;
    Fake& operator=(const Fake&) = delete;

  private:
    Function& place_;
    Function before_;
};

/// A GPU that has one extension and so much free memory.
class FakeGpu {
  public:
    FakeGpu(const std::string& extension, int nvidia_kib, int ati_kib = 0) {
        the_extension() = extension;
        nvidia() = nvidia_kib;
        ati() = ati_kib;
    }

  private:
    static std::string& the_extension() {
        static std::string name;
        return name;
    }
    static int& nvidia() {
        static int kib = 0;
        return kib;
    }
    static int& ati() {
        static int kib = 0;
        return kib;
    }
    Fake<PFNGLGETSTRINGPROC> name_{glad_glGetString, +[](GLenum) { return reinterpret_cast<const GLubyte*>("A GPU"); }};
    Fake<PFNGLGETSTRINGIPROC> extension_{
        glad_glGetStringi, +[](GLenum, GLuint) { return reinterpret_cast<const GLubyte*>(the_extension().c_str()); }};
    Fake<PFNGLGETINTEGERVPROC> number_{
        glad_glGetIntegerv, +[](GLenum what, GLint* value) {
            *value = what == GL_NUM_EXTENSIONS ? 1 : what == 0x9049 ? nvidia() : what == 0x87FC ? ati() : 0;
        }};
};

} // namespace bounce
