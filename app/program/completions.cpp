#include "app/program/completions.h"

#include <fmt/format.h>

#include <algorithm>

namespace trisect {
namespace {

constexpr const char* kHead = "# Made from the program's own table of options.\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// Words in single quotes, for bash and zsh.
std::string quoted(const std::string& text) {
  return "'" + replaced(text, "'", R"('\'')") + "'";
}

// Words in single quotes, for fish.
std::string fish_quoted(const std::string& text) {
  return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  return fmt::format("{}", fmt::join(words, between));
}

// "render" of "trisect render", "bench speed"; empty of "trisect".
std::string below_program(const CommandPage& page) {
  const std::size_t space = page.path.find(' ');
  return space == std::string::npos ? "" : page.path.substr(space + 1);
}

// "_trisect_bench_speed"
std::string function_name(const CommandPage& page) {
  return "_" + replaced(page.path, " ", "_");
}

// The names of the files without the first full stop, which the patterns of the shells have.
std::vector<std::string> without_stop(const std::vector<std::string>& endings) {
  std::vector<std::string> words;
  words.reserve(endings.size());
  for (const std::string& ending : endings) words.push_back(ending.substr(1));
  return words;
}

// The command of bash that offers values.
std::string bash_offer(const Suggestions& suggestions) {
  switch (suggestions.kind) {
    case Suggestions::Kind::names:
      return "_trisect_words " + joined(suggestions.words, " ");
    case Suggestions::Kind::files:
      return "_trisect_files " + joined(without_stop(suggestions.words), " ");
    case Suggestions::Kind::folders:
      return "_trisect_folders";
    case Suggestions::Kind::nothing:
      break;
  }
  return ":";
}

std::string bash_command(const CommandPage& page) {
  std::vector<std::string> words;
  for (const CommandPage& command : page.commands) words.push_back(command.name());
  std::string text = fmt::format("    {})\n", quoted(below_program(page)));
  text += "      case $previous in\n";
  std::string argument = ":";
  std::string without;  // suggestions: options that take other values
  for (const OptionPage& option : page.options) {
    if (option.is_argument) {
      argument = bash_offer(option.suggestions);
      continue;
    }
    words.insert(words.end(), option.names.begin(), option.names.end());
    if (option.value.empty()) continue;
    const std::string names = joined(option.names, " | ");
    if (option.suggestions.kind == Suggestions::Kind::nothing) {
      without += (without.empty() ? "" : " | ") + names;
    } else {
      text += fmt::format("        {}) {}; return ;;\n", names, bash_offer(option.suggestions));
    }
  }
  if (!without.empty()) text += fmt::format("        {}) return ;;\n", without);
  text += "      esac\n";
  const std::string offer = "_trisect_words " + joined(words, " ");
  if (page.commands.empty()) {
    text +=
        fmt::format("      if [[ $current == -* ]]; then {}; else {}; fi ;;\n", offer, argument);
  } else {
    text += fmt::format("      {} ;;\n", offer);
  }
  return text;
}

// What stands in [] of a specification of zsh's _arguments.
std::string zsh_text(const std::string& text) {
  return replaced(replaced(replaced(replaced(text, "\\", "\\\\"), "[", "\\["), "]", "\\]"), ":",
                  "\\:");
}

// Description and action of a value for _arguments.
std::string zsh_value(const OptionPage& option) {
  const std::string name = option.is_argument ? option.names.front() : option.value;
  std::string action = " ";
  switch (option.suggestions.kind) {
    case Suggestions::Kind::names:
      action = "(" + joined(option.suggestions.words, " ") + ")";
      break;
    case Suggestions::Kind::files:
      action = option.suggestions.words.empty()
                   ? "_files"
                   : fmt::format("_files -g \"(#i)*.({})\"",
                                 joined(without_stop(option.suggestions.words), "|"));
      break;
    case Suggestions::Kind::folders:
      action = "_files -/";
      break;
    case Suggestions::Kind::nothing:
      break;
  }
  return fmt::format(":{}:{}", zsh_text(name), action);
}

std::string zsh_command(const CommandPage& page) {
  std::string text = function_name(page) + "() {\n";
  std::vector<std::string> specifications;
  int place = 0;
  for (const OptionPage& option : page.options) {
    if (option.is_argument) {
      const std::string where = option.may_repeat ? "*" : std::to_string(++place);
      specifications.push_back(quoted(where + zsh_value(option)));
      continue;
    }
    const std::string others = option.may_repeat ? "*" : "(" + joined(option.names, " ") + ")";
    for (const std::string& name : option.names) {
      const std::string joint = option.value.empty() ? "" : name.starts_with("--") ? "=" : "+";
      const std::string value = option.value.empty() ? "" : zsh_value(option);
      specifications.push_back(
          quoted(fmt::format("{}{}{}[{}]{}", others, name, joint, zsh_text(option.text), value)));
    }
  }
  if (page.commands.empty()) {
    return text + "  _arguments -s -S \\\n    " + joined(specifications, " \\\n    ") + "\n}\n\n";
  }
  text += "  local curcontext=$curcontext state line\n  typeset -A opt_args\n  local -a commands\n";
  text += "  commands=(\n";
  std::string cases;
  for (const CommandPage& command : page.commands) {
    text += "    " + quoted(command.name() + ":" + zsh_text(command.summary)) + "\n";
    cases += fmt::format("        {}) {} ;;\n", command.name(), function_name(command));
  }
  text += "  )\n  _arguments -C \\\n    " + joined(specifications, " \\\n    ") +
          " \\\n    '1: :->command' '*:: :->rest'\n";
  text += "  case $state in\n    command) _describe command commands ;;\n    rest)\n";
  text += "      case $words[1] in\n" + cases + "      esac ;;\n  esac\n}\n\n";
  return text;
}

std::string fish_command(const CommandPage& page) {
  // Of a command with commands of its own they and its options are offered right after it only.
  const std::string when = (page.commands.empty() ? "__trisect_within" : "__trisect_just_after") +
                           (below_program(page).empty() ? "" : " " + below_program(page));
  const std::string head = "complete -c trisect -n " + fish_quoted(when);
  std::string text;
  for (const CommandPage& command : page.commands) {
    text += fmt::format("{} -a {} -d {}\n", head, command.name(), fish_quoted(command.summary));
  }
  for (const OptionPage& option : page.options) {
    text += head;
    if (!option.is_argument) {
      for (const std::string& name : option.names) {
        text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      if (!option.value.empty()) text += " -x";
      text += " -d " + fish_quoted(option.text);
    }
    switch (option.suggestions.kind) {
      case Suggestions::Kind::names:
        text += " -a " + fish_quoted(joined(option.suggestions.words, " "));
        break;
      case Suggestions::Kind::files:
        text += " -a " + fish_quoted("(__trisect_files " +
                                     joined(without_stop(option.suggestions.words), " ") + ")");
        break;
      case Suggestions::Kind::folders:
        text += " -a '(__fish_complete_directories)'";
        break;
      case Suggestions::Kind::nothing:
        break;
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string bash_completions(const CommandPage& program) {
  std::string text = std::string("# bash completion for trisect.\n") + kHead + R"(
_trisect_words() {
  mapfile -t COMPREPLY < <(compgen -W "$*" -- "$current")
}

_trisect_folders() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$current")
}

# Folders, and files whose names end in one of these; any file if none is given.
_trisect_files() {
  local file ending
  _trisect_folders
  while IFS= read -r file; do
    if [[ $# -eq 0 && ! -d $file ]]; then COMPREPLY+=("$file"); fi
    for ending in "$@"; do
      if [[ ${file,,} == *."$ending" && ! -d $file ]]; then COMPREPLY+=("$file"); fi
    done
  done < <(compgen -f -- "$current")
}

_trisect() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=
  COMPREPLY=()
  # --name=value comes as three words.
  if [[ $current == "=" ]]; then
    current=
  elif [[ $previous == "=" ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  if [[ $COMP_CWORD -gt 1 ]]; then command=${COMP_WORDS[1]}; fi
)";
  for (const CommandPage& command : program.commands) {
    if (command.commands.empty()) continue;
    text += fmt::format(
        "  if [[ $command == {} && $COMP_CWORD -gt 2 ]]; then command+=\" ${{COMP_WORDS[2]}}\"; "
        "fi\n",
        command.name());
  }
  text += "  case $command in\n";
  for (const CommandPage* page : all_pages(program)) text += bash_command(*page);
  return text + "  esac\n}\n\ncomplete -F _trisect trisect\n";
}

std::string zsh_completions(const CommandPage& program) {
  std::string text = std::string("#compdef trisect\n") + kHead + '\n';
  for (const CommandPage* page : all_pages(program)) text += zsh_command(*page);
  return text + "_trisect \"$@\"\n";
}

std::string fish_completions(const CommandPage& program) {
  std::string text = std::string("# fish completion for trisect.\n") + kHead + R"(
# Whether the words after trisect begin with these.
function __trisect_within
    set -l words (commandline -opc)
    set -e words[1]
    for word in $argv
        test "$words[1]" = "$word"; or return 1
        set -e words[1]
    end
end

# Whether they are these.
function __trisect_just_after
    __trisect_within $argv; and test (commandline -opc | count) -eq (math 1 + (count $argv))
end

# Folders, and files whose names end in one of these; any file if none is given.
function __trisect_files
    set -l pattern '^[^\t]*(/|\.('(string join '|' -- $argv)'))(\t|$)'
    test (count $argv) -eq 0; and set pattern .
    for file in (__fish_complete_path (commandline -ct | string replace -r -- '^-[^=]*=' ''))
        string match -rqi -- $pattern $file; and printf '%s\n' $file
    end
end

complete -c trisect -f
)";
  for (const CommandPage* page : all_pages(program)) text += fish_command(*page);
  return text;
}

}  // namespace trisect
