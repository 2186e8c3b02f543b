#pragma once
// A program that outlives its mistakes: it is compiled aside, and swapped in only when all of it is right.

#include "gpu/shader_source.h"

#include <functional>
#include <glad/gl.h>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace bounce {

struct UniformInfo {
    std::string name; ///< without "[0]"
    GLenum type = 0;
    GLint location = -1;
    GLint count = 1;
};
struct OpaqueInfo {
    std::string name;
    GLenum type = 0; ///< GL_SAMPLER_2D, GL_UNSIGNED_INT_IMAGE_3D …
    GLint unit = 0;  ///< assigned when linked: 0, 1, … for samplers and for images apart
    GLint count = 1;
};
struct BlockInfo {
    std::string name;
    GLuint binding = 0; ///< assigned when linked
};

/// What the linked program really uses.
struct ProgramInterface {
    std::vector<UniformInfo> uniforms;
    std::vector<OpaqueInfo> samplers, images;
    std::vector<BlockInfo> storage_blocks, uniform_blocks;
    glm::ivec3 local_size{1};
};

class Program {
  public:
    /// `stages`: files relative to the glsl folder. Nothing is compiled yet.
    Program(std::string name, std::vector<std::filesystem::path> stages, std::filesystem::path folder);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    /// Reads the sources (no OpenGL), unless these defines and values are those of the last scan and no file is known
    /// to have changed. Afterwards parameters(), slots(), files() are those of the files as they are; while one cannot
    /// be read (an editor may be halfway through saving it), parameters and slots stay as they were.
    void scan(const Defines& defines, const Defines& static_values);
    /// One of the files has changed: the next scan reads them again.
    void files_changed() { scanned_ = false; }
    /// Compiles and links what was scanned; `check` may refuse the interface (it returns what is wrong). On success the
    /// new program replaces the old; on failure the last good one stays and errors() says why. Returns success.
    bool build(const std::function<std::vector<std::string>(const ProgramInterface&)>& check);

    const std::string& name() const { return name_; }
    bool usable() const { return id_ != 0; } ///< a good program is there (perhaps an older one)
    bool disabled() const { return disabled_; }
    bool up_to_date() const { return up_to_date_; } ///< and it is the newest text
    GLuint id() const { return id_; }
    /// Of the text that id() was made of; 0: there is none.
    uint64_t text_digest() const { return id_ ? text_digest_ : 0; }
    const ProgramInterface& interface() const { return interface_; }
    const std::vector<ShaderError>& errors() const { return errors_; }
    const std::vector<std::filesystem::path>& files() const { return files_; }
    const std::vector<ParameterInfo>& parameters() const { return parameters_; }
    const std::vector<ShaderSlot>& slots() const { return slots_; }
    const std::vector<ShaderSource>& sources() const { return sources_; }
    /// While calls are watched (call_watch.h): what its text says of the order of its invocations (shader_order.h).
    const std::vector<std::string>& order_problems() const { return order_problems_; }
    const std::vector<std::filesystem::path>& stages() const { return stages_; }
    /// Takes up what an earlier build() of this same text came to, without asking the driver again.
    void recall(std::vector<ShaderError> errors);
    /// Lets go of the program after it hung the GPU, until enable() or a change of its text; `why`: "the GPU was reset
    /// while …".
    void disable(std::string why);
    void enable() { disabled_ = false; }
    const std::string& why_disabled() const { return why_disabled_; }
    /// Before the context goes: lets go of the OpenGL program, and keeps the text that it was made of.
    void release();
    /// In another context: makes the program again that release() let go of, if there was one. errors() stay those of
    /// the newest text.
    void restore();

  private:
    void destroy();
    /// Compiles and links `sources`; on success the program becomes this one's. Returns what is wrong.
    std::vector<ShaderError> make(const std::vector<ShaderSource>& sources,
                                  const std::function<std::vector<std::string>(const ProgramInterface&)>& check);

    std::string name_;
    std::vector<std::filesystem::path> stages_;
    std::filesystem::path folder_;
    std::vector<ShaderSource> sources_;
    std::vector<ShaderSource> made_of_; ///< the text of id_
    std::vector<std::filesystem::path> files_;
    std::vector<ParameterInfo> parameters_;
    std::vector<ShaderSlot> slots_;
    std::vector<ShaderError> errors_;
    std::vector<std::string> order_problems_;
    ProgramInterface interface_;
    Defines defines_, static_values_; ///< of the last scan
    GLuint id_ = 0;
    uint64_t text_digest_ = 0;
    bool scanned_ = false;
    bool up_to_date_ = false;
    bool read_once_ = false; ///< all files have been read without an error at some time
    bool disabled_ = false;
    std::string why_disabled_;
};

/// Sets one uniform from a parameter's value, converting between int, uint, bool and float as the uniform's type asks.
/// Returns false when the types do not go together.
bool set_uniform(GLuint program, const UniformInfo& uniform, const ParameterValue& value);
/// Whether set_uniform would take such a value.
bool uniform_takes(GLenum uniform_type, const ParameterValue& value);

} // namespace bounce
