#include "graph/nan_check.h"

#include "core/error.h"
#include "core/paths.h"
#include "gpu/barrier.h"

namespace bounce {

NanCheck::NanCheck() : counter_(4, nullptr, "non-finite counter") {
    for (int kind = 0; kind < 3; ++kind) {
        auto program = std::make_unique<Program>(
            "nan_check", std::vector<std::filesystem::path>{"graph/nan_check.comp"}, glsl_folder());
        program->scan({{"TEXTURE_KIND", std::to_string(kind)}}, {});
        if (!program->build({})) throw Error(program->errors().front().text());
        programs_[kind] = std::move(program);
    }
}

uint64_t NanCheck::count(const GpuTexture& texture) {
    const TextureDesc& desc = texture.desc();
    if (format_by_enum(desc.format).kind != FormatClass::floating) return 0;
    counter_.clear();
    Program& program = *programs_[int(desc.kind)];
    glUseProgram(program.id());
    glBindTextureUnit(0, texture.id());
    glBindSampler(0, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counter_.id());
    memory_barrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    glm::ivec3 local = program.interface().local_size;
    glDispatchCompute(GLuint((desc.size.x + local.x - 1) / local.x), GLuint((desc.size.y + local.y - 1) / local.y),
                      GLuint(desc.size.z));
    memory_barrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT); // read here, counted in anew
    uint32_t count = 0;
    counter_.read(0, 4, &count);
    return count;
}

} // namespace bounce
