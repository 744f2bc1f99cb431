// SPDX-License-Identifier: Apache-2.0
/// @file completion: scripts for shells, made of the command line's own description.
#include "program.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace terminal {

namespace {

/// A command by its words, as "gains get", and what may follow it.
struct Entry {
  std::string words{};
  std::vector<const CLI::App*> commands{};
  std::vector<std::string> options{};
};

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

void collect(const CLI::App& app, const std::string& words, const std::vector<std::string>& common,
             std::vector<Entry>& entries) {
  Entry entry{.words = words};
  entry.options = options_of(app);
  for (const std::string& option : common) {
    if (std::ranges::find(entry.options, option) == entry.options.end()) {
      entry.options.push_back(option);
    }
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    entry.commands.push_back(command);
  }
  entries.push_back(entry);
  for (const CLI::App* command : entry.commands) {
    collect(*command, words.empty() ? command->get_name() : words + " " + command->get_name(),
            common, entries);
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::vector<std::string> names_of(const Entry& entry) {
  std::vector<std::string> names;
  for (const CLI::App* command : entry.commands) names.push_back(command->get_name());
  return names;
}

/// A shell word for a text: in single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// A function of the shell that finds the command in what was typed, and its words by a `case`.
/// Names of files are completed where nothing else fits.
std::string bash(const std::vector<Entry>& entries) {
  std::string known;
  std::string cases;
  for (const Entry& entry : entries) {
    if (!entry.words.empty()) known += "|" + quoted(entry.words);
    cases += "    " + quoted(entry.words) +
             ") words=" + quoted(joined(names_of(entry)) + " " + joined(entry.options)) + " ;;\n";
  }
  return R"(_articula() {
  local command='' next word words='' i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    next=${command:+$command }$word
    case $next in
      )" +
         known.substr(known.empty() ? 0 : 1) +
         R"() command=$next ;;
    esac
  done
  case $command in
)" + cases +
         R"(  esac
  COMPREPLY=($(compgen -W "$words" -- "${COMP_WORDS[COMP_CWORD]}"))
}
complete -o default -F _articula articula
)";
}

std::string zsh(const std::vector<Entry>& entries) {
  return "#compdef articula\nautoload -U +X bashcompinit && bashcompinit\n" + bash(entries);
}

std::string fish(const std::vector<Entry>& entries) {
  std::string text = R"(function __articula_is
  set -l words
  for word in (commandline -opc)[2..-1]
    string match -q -- '-*' $word; or set -a words $word
  end
  string match -q -- "$argv[1] *" "$words "; or test "$argv[1]" = "$words"
end
function __articula_is_first
  set -l words
  for word in (commandline -opc)[2..-1]
    string match -q -- '-*' $word; or set -a words $word
  end
  test -z "$words"
end
)";
  for (const Entry& entry : entries) {
    const std::string condition =
        entry.words.empty() ? "__articula_is_first" : "__articula_is " + quoted(entry.words);
    for (const CLI::App* command : entry.commands) {
      const std::string files = entry.words.empty() ? "" : " -f";
      text += "complete -c articula" + files + " -n " + quoted(condition) + " -a " +
              quoted(command->get_name()) + " -d " + quoted(command->get_description()) + "\n";
    }
    for (const std::string& option : entry.options) {
      text +=
          "complete -c articula -n " + quoted(condition) + " -l " + quoted(option.substr(2)) + "\n";
    }
  }
  return text;
}

}  // namespace

void add_completion_command(CLI::App& app, Program& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* command = add_command(app, program, "completion",
                                  "Prints a script with which a shell completes these commands.",
                                  [&app, &program, shell] {
                                    std::vector<Entry> entries;
                                    collect(app, "", options_of(app), entries);
                                    const std::string script = *shell == "bash"  ? bash(entries)
                                                               : *shell == "zsh" ? zsh(entries)
                                                                                 : fish(entries);
                                    program.print({{"shell", *shell}, {"script", script}}, script);
                                  });
  command->add_option("shell", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->footer("as: source <(articula completion bash)");
}

}  // namespace terminal
