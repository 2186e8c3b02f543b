// bounce completion: a script that completes subcommands, options and names, for bash and zsh.
#include "app/commands/completion.h"

#include "app/commands/command.h"
#include "app/commands/option_checks.h"
#include "app/listing.h"
#include "app/print.h"
#include "core/error.h"
#include "core/text.h"

#include <fmt/format.h>

namespace bounce {

namespace {

/// What stands for the value of an option, or of an argument without one, by the name of its type in the help text.
std::string kinds_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    if (type == "SHOT") return "shots scenes";
    if (type == "GRAPH" || type == "GRAPHS") return "graphs";
    if (type == "SWEEP") return "sweeps";
    if (type == "TABLE") return "tables";
    if (type == "METRIC") return "metrics";
    if (type == "KIND") return "kinds";
    if (type == "SHELL") return "shells";
    return type == "FILE" ? "files" : "none";
}

std::vector<std::string> spellings(const CLI::Option& option) {
    std::vector<std::string> all;
    for (const std::string& name : option.get_lnames())
        all.push_back("--" + name);
    for (const std::string& name : option.get_snames())
        all.push_back("-" + name);
    return all;
}

std::vector<const CLI::Option*> shown_options(const CLI::App& app) {
    std::vector<const CLI::Option*> shown;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty()) shown.push_back(option);
    return shown;
}

std::vector<std::string> subcommands(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty()) names.push_back(command->get_name());
    return names;
}

/// The branches of a `case "$command:$before"` for one command: after an option that takes a value, what the value may
/// be; else options, subcommands and arguments.
std::string branches(const CLI::App& app, const std::string& path) {
    std::string text, arguments = "none";
    std::vector<std::string> options;
    for (const CLI::Option* option : shown_options(app)) {
        const std::vector<std::string> own = spellings(*option);
        options.insert(options.end(), own.begin(), own.end());
        if (own.empty() && (arguments == "none" || arguments == "files")) arguments = kinds_of(*option);
        if (own.empty() || option->get_items_expected_max() == 0) continue;
        std::vector<std::string> patterns;
        for (const std::string& name : own)
            patterns.push_back(path + ":" + name);
        text += fmt::format("    {}) kinds=\"{}\" ;;\n", join(patterns, "|"), kinds_of(*option));
    }
    const std::vector<std::string> below = subcommands(app);
    if (!below.empty()) arguments = "";
    text += fmt::format("    {}:*) kinds=\"{}\" below=\"{}\" flags=\"{}\" ;;\n", path, arguments, join(below, " "),
                        join(options, " "));
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty())
            text += branches(*command, path.empty() ? command->get_name() : path + "-" + command->get_name());
    return text;
}

/// `path` becomes the commands so far ("new-pass"), by each word that is one of the present command's.
std::string steps(const CLI::App& app, const std::string& path) {
    std::string text;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (command->get_group().empty()) continue;
        const std::string next = path.empty() ? command->get_name() : path + "-" + command->get_name();
        text += fmt::format("      \"{}:{}\") command={} ;;\n", path, command->get_name(), next);
        text += steps(*command, next);
    }
    return text;
}

std::string kind_names() {
    std::vector<std::string> names;
    for (const NameKind& kind : name_kinds())
        names.push_back(kind.name);
    return join(names, " ");
}

/// What both shells understand: a line for each candidate. @split@ is how the shell splits "$kinds" into words.
constexpr const char* k_common = R"sh(  local kinds="" below="" flags="" kind
  case "$command:$before" in
@branches@  esac
  for kind in @split@; do
    case $kind in
    none|files) ;;
    kinds) below="@kinds@" ;;
    shells) below="bash zsh" ;;
    *) candidates+="$("$program" list "$kind" 2>/dev/null)"$'\n' ;;
    esac
  done
  candidates+=${below// /$'\n'}
)sh";

constexpr const char* k_bash = R"sh(# Completion of bounce for bash. Load it with: source <(bounce completion bash)
_bounce() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  local command="" candidates="" candidate head="" i
  # app/run builds first; what it built can answer.
  [[ $program == */run && -x ${program%/run}/../build/bounce ]] && program=${program%/run}/../build/bounce
  # bash splits --graph=x into three words.
  if [[ $word == = ]]; then word=""; elif [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$command:${COMP_WORDS[i]}" in
@steps@    esac
  done
@common@  [[ $word == -* ]] && candidates=${flags// /$'\n'}
  [[ $word == *,* ]] && head=${word%,*},
  COMPREPLY=()
  while IFS= read -r candidate; do
    [[ -n $candidate && $candidate == "${word##*,}"* ]] && COMPREPLY+=("$head$candidate")
  done <<< "$candidates"
  # Where no file is meant, none is offered.
  [[ $kinds == none ]] && compopt +o default 2>/dev/null
  return 0
}
complete -o default -F _bounce bounce app/run
)sh";

constexpr const char* k_zsh = R"sh(#compdef bounce
# Completion of bounce for zsh. Load it, after compinit, with: source <(bounce completion zsh)
_bounce() {
  local program=${words[1]} word=${words[CURRENT]} before=${words[CURRENT-1]}
  local command="" candidates="" i
  [[ $program == */run && -x ${program%/run}/../build/bounce ]] && program=${program%/run}/../build/bounce
  for ((i = 2; i < CURRENT; ++i)); do
    case "$command:${words[i]}" in
@steps@    esac
  done
  if [[ $word == --*=* ]]; then before=${word%%=*}; compset -P '*='; fi
@common@  if [[ $word == -* && $word != *=* ]]; then candidates=${flags// /$'\n'}; fi
  compset -P '*,'
  compadd -- ${(f)candidates}
  [[ $kinds == *files* ]] && _files
  return 0
}
compdef _bounce bounce
)sh";

/// The text with each @name@ replaced.
std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
    for (const auto& [name, value] : values) {
        const std::string mark = "@" + name + "@";
        for (size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
            text.replace(at, mark.size(), value);
    }
    return text;
}

} // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
    if (shell != "bash" && shell != "zsh") throw Error("invalid shell '" + shell + "': expected bash or zsh");
    const bool bash = shell == "bash";
    const std::string common = filled(
        k_common, {{"split", bash ? "$kinds" : "${=kinds}"}, {"branches", branches(app, "")}, {"kinds", kind_names()}});
    return filled(bash ? k_bash : k_zsh, {{"steps", steps(app, "")}, {"common", common}});
}

void add_completion_command(CLI::App& app, CommandFunction& chosen) {
    auto* command = app.add_subcommand("completion", "print a script that completes command lines in a shell");
    auto shell = std::make_shared<std::string>();
    command->add_option("shell", *shell, "bash or zsh")->required()->type_name("SHELL")->check(one_of({"bash", "zsh"}));
    command->callback([shell, &app, &chosen] {
        chosen = [shell, &app] {
            print("{}", completion_script(app, *shell));
            return 0;
        };
    });
}

} // namespace bounce
