#include "graph/allocations.h"

#include "gpu/device_memory.h"

#include <algorithm>

namespace bounce {

void Allocations::update(const Plan& plan) {
    std::vector<std::unique_ptr<Entry>> next;
    std::map<size_t, Entry> copies;                // last frame's, by new index: made before anything old is given up
    std::vector<std::pair<size_t, size_t>> reused; // new index, old index
    for (const PlanResource& resource : plan.resources) {
        auto fits = [&](const std::unique_ptr<Entry>& e) {
            return e && e->name == resource.name() && e->is_buffer == resource.is_buffer() &&
                   (e->is_buffer ? e->bytes == resource.bytes : e->desc == resource.texture);
        };
        auto old = std::find_if(entries_.begin(), entries_.end(), fits);
        bool has_copy = old != entries_.end() && ((*old)->previous_texture || (*old)->previous_buffer);
        if (resource.needs_previous && !has_copy) {
            Entry& copy = copies[next.size()];
            if (resource.is_buffer())
                copy.previous_buffer = Buffer(resource.bytes, nullptr, resource.name() + " (previous)");
            else
                copy.previous_texture = GpuTexture(resource.texture, resource.name() + " (previous)");
        }
        if (old != entries_.end()) {
            reused.emplace_back(next.size(), size_t(old - entries_.begin()));
            next.push_back(nullptr);
            continue;
        }
        auto entry = std::make_unique<Entry>();
        entry->name = resource.name();
        entry->serial = ++made_;
        entry->is_buffer = resource.is_buffer();
        entry->desc = resource.texture;
        entry->bytes = resource.bytes;
        if (entry->is_buffer) {
            entry->buffer = Buffer(resource.bytes, nullptr, resource.name());
            entry->buffer.clear();
        } else {
            entry->texture = GpuTexture(resource.texture, resource.name());
            entry->texture.clear(resource.declaration.neutral);
        }
        next.push_back(std::move(entry));
    }
    // Some drivers find their memory only when an object is first filled.
    if (drop_errors()) throw OutOfDeviceMemory("the driver ran out of memory when it filled them");
    for (auto [to, from] : reused)
        next[to] = std::move(entries_[from]);
    for (size_t i = 0; i < next.size(); ++i) {
        const PlanResource& resource = plan.resources[i];
        Entry& entry = *next[i];
        if (!resource.needs_previous) {
            entry.previous_texture = {};
            entry.previous_buffer = {};
        } else if (resource.is_buffer() && !entry.previous_buffer) {
            entry.previous_buffer = std::move(copies.at(i).previous_buffer);
            entry.previous_buffer.clear();
        } else if (!resource.is_buffer() && !entry.previous_texture) {
            entry.previous_texture = std::move(copies.at(i).previous_texture);
            entry.previous_texture.clear(resource.declaration.neutral);
        }
    }
    framebuffers_.clear(); // they name resources by index
    entries_ = std::move(next);
}

void Allocations::release() {
    framebuffers_.clear();
    entries_.clear();
}

const GpuTexture& Allocations::texture(int resource, bool previous) const {
    const Entry& entry = *entries_[size_t(resource)];
    return previous ? entry.previous_texture : entry.texture;
}

const Buffer& Allocations::buffer(int resource, bool previous) const {
    const Entry& entry = *entries_[size_t(resource)];
    return previous ? entry.previous_buffer : entry.buffer;
}

const GpuTexture& Allocations::view(int resource, bool previous, int mip, int layer, bool as_2d) {
    Entry& entry = *entries_[size_t(resource)];
    const GpuTexture& whole = previous ? entry.previous_texture : entry.texture;
    const TextureDesc& desc = whole.desc();
    bool array = desc.kind == TextureKind::texture_2d_array;
    bool one_layer = array && (layer >= 0 || as_2d);
    if (mip < 0 && !one_layer) return whole;
    auto key = std::make_tuple(previous, mip, layer, as_2d);
    auto found = entry.views.find(key);
    if (found == entry.views.end()) {
        int first_mip = std::clamp(mip < 0 ? 0 : mip, 0, desc.mips - 1);
        int mips = mip < 0 ? desc.mips : 1;
        int first_layer = one_layer ? std::clamp(layer, 0, desc.size.z - 1) : 0;
        int layers = one_layer ? 1 : array ? desc.size.z : 1;
        TextureKind kind = one_layer && as_2d ? TextureKind::texture_2d : desc.kind;
        found = entry.views.emplace(key, whole.view(kind, first_mip, mips, first_layer, layers)).first;
    }
    return found->second;
}

const Framebuffer& Allocations::framebuffer(const std::vector<std::tuple<int, int, int>>& colours,
                                            std::tuple<int, int, int> depth, glm::ivec2 size) {
    std::vector<int> key;
    auto add = [&](const std::tuple<int, int, int>& t) {
        key.insert(key.end(), {std::get<0>(t), std::get<1>(t), std::get<2>(t)});
    };
    for (const auto& colour : colours)
        add(colour);
    add(depth);
    key.insert(key.end(), {size.x, size.y});
    auto found = framebuffers_.find(key);
    if (found != framebuffers_.end()) return found->second;
    auto attachment = [&](const std::tuple<int, int, int>& t) {
        auto [resource, mip, layer] = t;
        return resource < 0 ? Attachment{} : Attachment{&texture(resource), mip, layer};
    };
    std::vector<Attachment> attachments;
    std::string name = "framebuffer of";
    for (const auto& colour : colours) {
        attachments.push_back(attachment(colour));
        name += " " + entries_[size_t(std::get<0>(colour))]->name;
    }
    return framebuffers_.emplace(key, Framebuffer(attachments, attachment(depth), name, size)).first->second;
}

void Allocations::clear(int resource, glm::vec4 value) const {
    const Entry& entry = *entries_[size_t(resource)];
    if (entry.is_buffer)
        entry.buffer.clear();
    else
        entry.texture.clear(value);
}

void Allocations::keep_previous(int resource) const {
    const Entry& entry = *entries_[size_t(resource)];
    if (entry.is_buffer) {
        glCopyNamedBufferSubData(entry.buffer.id(), entry.previous_buffer.id(), 0, 0, GLsizeiptr(entry.bytes));
        return;
    }
    GLenum target = gl_target(entry.desc.kind);
    for (int mip = 0; mip < entry.desc.mips; ++mip) {
        glm::ivec3 size = mip_size(entry.desc, mip);
        glCopyImageSubData(entry.texture.id(), target, mip, 0, 0, 0, entry.previous_texture.id(), target, mip, 0, 0, 0,
                           size.x, size.y, size.z);
    }
}

void Allocations::reset(const Plan& plan, int resource) const {
    const ResourceDeclaration& declaration = plan.resources[size_t(resource)].declaration;
    const Entry& entry = *entries_[size_t(resource)];
    if (declaration.persistent || declaration.incremental) clear(resource, declaration.neutral);
    if (entry.previous_texture) entry.previous_texture.clear(declaration.neutral);
    if (entry.previous_buffer) entry.previous_buffer.clear();
}

} // namespace bounce
