#pragma once
// What the watched calls have bound, and what memory a command reaches through it.

#include "gpu/memory_use.h"
#include "gpu/shader_memory.h"

#include <map>
#include <string>
#include <vector>

namespace bounce {

class CallState {
  public:
    struct ImageUnit {
        GLuint texture = 0;
        GLint level = 0;
        bool layered = false;
        GLint layer = 0;
        GLenum format = 0;
    };
    struct BufferUnit {
        GLuint buffer = 0;
        int64_t begin = 0, end = -1; ///< −1: all of it
    };
    struct Attachment {
        GLuint texture = 0;
        GLint level = 0, layer = -1; ///< −1: all layers
    };
    /// Of a texture that is a view of another: that one, and where in it the view begins.
    struct Texture {
        GLuint origin = 0;
        int first_mip = 0, mips = 1;
        int first_layer = 0, layers = 1; ///< slices of a volume
    };
    struct VertexArray {
        std::map<GLuint, GLuint> buffers; ///< by binding
        GLuint indices = 0;
    };

    GLuint program = 0, framebuffer = 0, vertex_array = 0;
    std::map<GLenum, GLuint> indirect; ///< by target
    std::map<GLuint, GLuint> sampled;  ///< by unit
    std::map<GLuint, ImageUnit> images;
    std::map<GLuint, BufferUnit> storage, uniforms;
    std::map<GLuint, Texture> textures;
    std::map<GLuint, std::map<GLenum, Attachment>> framebuffers;
    std::map<GLuint, VertexArray> vertex_arrays;
    std::map<GLuint, std::string> shader_texts;
    std::map<GLuint, std::vector<GLuint>> attached; ///< shaders of a program that is being linked
    std::map<std::pair<GLenum, GLuint>, std::string> labels;
    std::vector<std::string> groups; ///< of debug output, which the graph opens for each pass

    void linked(GLuint which);
    void program_is_gone(GLuint which) { programs_.erase(which); }

    MemoryRange texture_range(GLuint texture, int level, int levels, int layer, int layers) const;
    /// All of it, as a sampler sees it.
    MemoryRange whole_texture(GLuint texture) const;
    static MemoryRange buffer_range(GLuint buffer, int64_t begin, int64_t end);

    /// What the bound program declares, at what is bound there now. `problems`: images bound with another format.
    void add_program(std::vector<MemoryUse>& uses, std::vector<std::string>& problems);
    void add_framebuffer(std::vector<MemoryUse>& uses) const;
    void add_vertices(std::vector<MemoryUse>& uses, bool indices) const;
    void add_indirect(std::vector<MemoryUse>& uses, GLenum target, int64_t offset, int64_t bytes) const;

    /// "'voxels.radiance' mip 2 layer 1".
    std::string describe(const MemoryRange& range) const;
    std::string label(GLenum kind, GLuint name, const char* otherwise) const;

  private:
    struct Binding {
        std::string name;
        MemoryRoute route = MemoryRoute::sampler;
        GLuint unit = 0, count = 1;
        ShaderMemory memory;
    };
    struct Program {
        std::map<std::string, ShaderMemory> declared;
        std::vector<Binding> bindings;
        bool asked = false; ///< for its bindings, which are set after it has been linked
    };
    static std::vector<Binding> bindings_of(GLuint which, const std::map<std::string, ShaderMemory>& declared);

    std::map<GLuint, Program> programs_;
};

} // namespace bounce
