// bounce new pass: writes a working pass to start from.
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/new_pass.h"
#include "app/print.h"

#include <fmt/format.h>

namespace bounce {

void add_new_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("new", "write a working pass to start from");
    command->require_subcommand(1);
    auto* pass =
        command->add_subcommand("pass", "a compute shader and its entry in a graph file (and C++, with --cpp)");
    auto request = std::make_shared<NewPass>();
    pass->add_option("name", request->name, "lower case letters, digits and underscores")->required();
    pass->add_option("--graph,-g", request->graph, "the graph file that gets the entry")
        ->type_name("GRAPH")
        ->check(not_empty())
        ->capture_default_str();
    pass->add_flag("--cpp", request->cpp, "also write a C++ pass class");
    pass->callback([request, &chosen] {
        chosen = [request] {
            print("{}", write_new_pass(*request));
            return 0;
        };
    });
}

} // namespace bounce
