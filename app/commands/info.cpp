// bounce info: what a scene or shot holds, and so what it needs.
#include "app/commands/command.h"
#include "app/omitted_light.h"
#include "app/print.h"
#include "reference/scene_needs.h"
#include "scene/describe.h"
#include "scene/shot.h"

#include <fmt/format.h>

namespace bounce {

void add_info_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("info", "tell what a scene or shot holds, what was skipped, and what it needs");
    auto file = std::make_shared<std::string>();
    command->add_option("file", *file, "a scene (.gltf, .glb) or shot")->type_name("SHOT")->required();
    command->callback([file, &chosen] {
        chosen = [file] {
            const Shot shot = load_shot(*file);
            print("{}{}", describe_scene(shot), describe_omitted_light(shot_facts(shot)));
            for (const auto& [name, need] : scene_needs(shot))
                print("{:<14}{} {:.6g}: {}\n", "auto", name, need.value, need.reason);
            return 0;
        };
    });
}

} // namespace bounce
