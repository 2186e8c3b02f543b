#include "app/commands/usage_error.h"

#include "core/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace bounce {

namespace {

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    }
    return names;
}

/// The first word of the command line that CLI11 left over, options before others: what follows may be its value.
std::string first_left_over(const std::vector<std::string>& left, int argc, const char* const* argv) {
    for (bool option : {true, false}) {
        for (int i = 1; i < argc; ++i) {
            std::string word = argv[i];
            bool found = std::find(left.begin(), left.end(), word) != left.end();
            if (found && (word.size() > 1 && word[0] == '-') == option) return word;
        }
    }
    return left.empty() ? "" : left.front();
}

} // namespace

std::string usage_error(CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
    std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    std::string called = chosen.empty() ? "bounce" : "bounce " + command.get_name();
    std::string help = fmt::format(" ({} --help shows what there is)", called);
    if (dynamic_cast<const CLI::ValidationError*>(&error)) {
        // "--size: 'x': expected …", from option_checks.h
        const std::string text = error.what();
        const size_t colon = text.find(": '");
        return colon == std::string::npos ? text + help
                                          : fmt::format("invalid {} {}", text.substr(0, colon), text.substr(colon + 2));
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
        // "--size: 1 required TEXT missing"
        const std::string text = error.what();
        if (text.ends_with(" missing"))
            return fmt::format("invalid {}: expected a value behind it{}", text.substr(0, text.find(':')), help);
    }
    if (!dynamic_cast<const CLI::ExtrasError*>(&error)) return error.what() + help;

    std::string word = first_left_over(app.remaining(true), argc, argv);
    if (word.size() > 1 && word[0] == '-') {
        std::string name = word.substr(0, word.find('='));
        auto nearest = nearest_name(name, option_names(command));
        return fmt::format("'{}' has no option '{}'{}", called, name,
                           nearest ? " (did you mean '" + *nearest + "'?)" : help);
    }
    if (!chosen.empty()) return fmt::format("'{}' takes no further argument, but got '{}'{}", called, word, help);
    std::vector<std::string> commands;
    for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; }))
        if (!known->get_group().empty()) commands.push_back(known->get_name());
    return fmt::format("there is no command '{}'{}", word, did_you_mean(word, commands));
}

} // namespace bounce
