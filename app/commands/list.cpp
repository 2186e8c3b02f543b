// bounce list: the names that other commands take.
#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/listing.h"
#include "app/print.h"

#include <fmt/format.h>

namespace bounce {

void add_list_command(CLI::App& app, CommandFunction& chosen) {
    std::vector<std::string> kinds;
    for (const NameKind& kind : name_kinds())
        kinds.push_back(kind.name);
    auto* command = app.add_subcommand("list", "list the names that other commands take");
    auto wanted = std::make_shared<std::string>();
    command->add_option("kind", *wanted, CLI::detail::join(kinds, ", "))
        ->required()
        ->type_name("KIND")
        ->check(one_of(kinds));
    command->callback([wanted, &chosen] {
        chosen = [wanted] {
            for (const std::string& name : names_of(*wanted))
                print("{}\n", name);
            return 0;
        };
    });
}

} // namespace bounce
