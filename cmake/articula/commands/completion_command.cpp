// SPDX-License-Identifier: Apache-2.0
/// @file completion: scripts for shells, made of the command line's own description.
#include "program.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace terminal {

namespace {

/// A command by its words, as "gains get", and what may follow it.
struct Entry {
  std::string words{};
  std::vector<const CLI::App*> commands{};
  std::vector<std::string> options{};
  std::vector<std::string> valued_options{};
  std::string argument{};                              ///< type of its argument; empty: not named
  std::map<std::string, std::string> named_options{};  ///< types of options with named values
};

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Notes which options have values, and where names of the running loop are expected.
void collect_values(const CLI::App& app, Entry& entry) {
  for (const CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    const bool is_named = std::ranges::find(named_values, type) != named_values.end();
    if (is_named && option->get_lnames().empty()) entry.argument = type;
    for (const std::string& name : option->get_lnames()) {
      if (option->get_items_expected_max() > 0) entry.valued_options.push_back("--" + name);
      if (is_named) entry.named_options["--" + name] = type;
    }
  }
}

bool is_hidden(const CLI::App& app) { return app.get_group().empty(); }

void collect(const CLI::App& app, const std::string& words, const std::vector<std::string>& common,
             std::vector<Entry>& entries) {
  Entry entry{.words = words};
  entry.options = options_of(app);
  collect_values(app, entry);
  for (const std::string& option : common) {
    if (std::ranges::find(entry.options, option) == entry.options.end()) {
      entry.options.push_back(option);
    }
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!is_hidden(*command)) entry.commands.push_back(command);
  }
  entries.push_back(entry);
  for (const CLI::App* command : entry.commands) {
    collect(*command, words.empty() ? command->get_name() : words + " " + command->get_name(),
            common, entries);
  }
}

std::string joined(const std::vector<std::string>& words, const std::string& separator = " ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

std::vector<std::string> names_of(const Entry& entry) {
  std::vector<std::string> names;
  for (const CLI::App* command : entry.commands) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> valued_options(const std::vector<Entry>& entries) {
  std::set<std::string> options;
  for (const Entry& entry : entries) {
    options.insert(entry.valued_options.begin(), entry.valued_options.end());
  }
  return {options.begin(), options.end()};
}

/// A shell word for a text: in single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// A function of the shell that finds the command in what was typed, and its words by a `case`. A
/// second `case` finds the type of the names that are expected. The program prints them, with the
/// connection of what was typed. Names of files are completed where nothing else fits.
std::string bash(const std::vector<Entry>& entries) {
  std::string known;
  std::string cases, types, named;
  for (const Entry& entry : entries) {
    if (!entry.words.empty()) known += "|" + quoted(entry.words);
    cases += "    " + quoted(entry.words) +
             ") words=" + quoted(joined(names_of(entry)) + " " + joined(entry.options)) + " ;;\n";
    for (const auto& [option, type] : entry.named_options) {
      named += " " + entry.words + " " + option + ";";
      types += "    " + quoted(entry.words + " " + option) + ") type=" + quoted(type) + " ;;\n";
    }
    if (!entry.argument.empty()) {
      types += "    " + quoted(entry.words + " ") + ") type=" + quoted(entry.argument) + " ;;\n";
    }
  }
  return R"(_articula() {
  local command='' next word words='' names='' option='' type='' connection=() i
  local named=')" +
         named +
         R"('
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    case $word in
      --address | --port | --token)
        next=${COMP_WORDS[i + 1]}
        [[ $next != = ]] || next=${COMP_WORDS[i + 2]}
        connection+=("$word" "$next") ;;
    esac
    case $word in
      )" +
         joined(valued_options(entries), " | ") +
         R"() option=$word ;;
      -*) ;;
      *) [[ $named == *" $command $option;"* ]] || option='' ;;
    esac
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
  case "$command $option" in
)" + types +
         R"(  esac
  word=${COMP_WORDS[COMP_CWORD]}
  if [[ $word == = || ${COMP_WORDS[COMP_CWORD - 1]} == = ]]; then
    return
  elif [[ -n $type && $word != -* ]]; then
    names=$("${COMP_WORDS[0]}" "${connection[@]}" names "$type" 2>/dev/null)
    words=${names:-$words}
    [[ -z $names || $type != *=* ]] || compopt -o nospace 2>/dev/null
  fi
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _articula articula
)";
}

std::string zsh(const std::vector<Entry>& entries) {
  return "#compdef articula\nautoload -U +X bashcompinit && bashcompinit\n" + bash(entries);
}

std::string names_by_fish(const std::string& type) {
  return quoted("(__articula_names " + type + ")");
}

std::string fish(const std::vector<Entry>& entries) {
  const std::vector<std::string> valued = valued_options(entries);
  std::string text = R"(function __articula_words # without options and their values, and a space
  set -l words
  set -l is_value 0
  for word in (commandline -opc)[2..-1]
    if test $is_value = 1
      set is_value 0
      continue
    end
    switch $word
      case )" + joined(valued) +
                     R"(
        set is_value 1
      case '-*'
      case '*'
        set -a words $word
    end
  end
  echo "$words "
end
function __articula_is
  string match -q -- "$argv[1] *" (__articula_words)
end
function __articula_is_first
  test (__articula_words) = ' '
end
function __articula_names
  set -l words (commandline -opc)
  set -l connection
  for i in (seq (count $words))
    contains -- $words[$i] --address --port --token; and set -a connection $words[$i] $words[(math $i + 1)]
  end
  $words[1] $connection names $argv[1] 2>/dev/null
end
)";
  for (const Entry& entry : entries) {
    const std::string condition =
        entry.words.empty() ? "__articula_is_first" : "__articula_is " + quoted(entry.words);
    for (const CLI::App* command : entry.commands) {
      text += "complete -c articula -f -n " + quoted(condition) + " -a " +
              quoted(command->get_name()) + " -d " + quoted(command->get_description()) + "\n";
    }
    for (const std::string& option : entry.options) {
      text += "complete -c articula -n " + quoted(condition) + " -l " + quoted(option.substr(2));
      const auto named = entry.named_options.find(option);
      if (named != entry.named_options.end()) {
        text += " -x -a " + names_by_fish(named->second);
      } else if (std::ranges::find(valued, option) != valued.end()) {
        text += " -r";
      }
      text += "\n";
    }
    if (!entry.argument.empty()) {
      text += "complete -c articula -f -n " + quoted(condition) + " -a " +
              names_by_fish(entry.argument) + "\n";
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
