#include "app/program/manual.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "app/program/command_texts.h"
#include "app/program/help_format.h"

namespace trisect {
namespace {

// Text that roff prints as it is, with what a reader may copy in ASCII: a bare - is a hyphen, a
// bare ' a curved quote.
std::string roff(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '\\':
        safe += "\\e";
        break;
      case '-':
        safe += "\\-";
        break;
      case '\'':
        safe += "\\(aq";
        break;
      case '`':
        safe += "\\(ga";
        break;
      case '"':
        safe += "\\(dq";
        break;
      case '^':
        safe += "\\(ha";
        break;
      case '~':
        safe += "\\(ti";
        break;
      default:
        safe += letter;
    }
  }
  return safe;
}

// A line that begins with a full stop would be a request.
std::string roff_line(const std::string& line) {
  return (line.starts_with('.') ? "\\&" : "") + roff(line) + '\n';
}

std::string bold(const std::string& text) {
  return "\\fB" + roff(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + roff(text) + "\\fR";
}

// Prose in lines of a length that roff's readers expect; a sentence begins a line.
std::string paragraph(const std::string& text) {
  std::string lines;
  std::string sentence;
  const auto write = [&] {
    for (const std::string& line : wrapped(sentence, 60)) lines += roff_line(line);
    sentence.clear();
  };
  std::istringstream words(text);
  bool has_ended = false;
  for (std::string word; words >> word;) {
    if (has_ended && std::isupper(static_cast<unsigned char>(word[0])) != 0) write();
    sentence += word + ' ';
    has_ended = word.ends_with('.');
  }
  write();
  return lines;
}

// "\fB\-o\fR, \fB\-\-output\fR \fIFILE\fR"
std::string option_heading(const OptionPage& option) {
  std::string heading;
  for (const std::string& name : option.names) {
    if (!heading.empty()) heading += ", ";
    heading += option.is_argument ? italic(name) : bold(name);
  }
  if (!option.value.empty()) heading += ' ' + italic(option.value);
  return heading + (option.is_argument && option.may_repeat ? " ..." : "");
}

std::string sentence(std::string text) {
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string terms(const std::vector<Term>& list) {
  std::string text;
  for (const Term& term : list) {
    text += ".TP\n" + bold(term.name) + '\n' + paragraph(capitalised(sentence(term.text)));
  }
  return text;
}

std::string options_section(const CommandPage& page) {
  std::string text = ".SH OPTIONS\n";
  for (const OptionGroup& group : option_groups(page)) {
    text += ".SS " + roff(group.name) + '\n';
    for (const OptionPage* option : group.options) {
      text += ".TP\n" + option_heading(*option) + '\n' + paragraph(sentence(option->text));
    }
  }
  return text;
}

std::string examples_section(const std::vector<Example>& examples) {
  std::string text = ".SH EXAMPLES\n";
  bool is_first = true;
  for (const Example& example : examples) {
    if (!is_first) text += ".PP\n";
    is_first = false;
    text += paragraph(example.what + ':') + ".PP\n.nf\n.RS\n";
    // A long line goes on after a backslash, as in a shell.
    const std::vector<std::string> parts = wrapped(example.line, 64);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      text += (i == 0 ? "" : "  ") + roff(parts[i]) + (i + 1 == parts.size() ? "\n" : " \\e\n");
    }
    text += ".RE\n.fi\n";
  }
  return text;
}

std::string reference(const CommandPage& page) {
  return ".BR " + roff(manual_name(page)) + " (1)";
}

}  // namespace

std::string manual_name(const CommandPage& page) {
  std::string name = page.path;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string manual_page(const CommandPage& program, const CommandPage& page,
                        const std::string& version, const std::string& date) {
  const bool is_program = page.path == program.path;
  const CommandTexts texts = command_texts(page.path);
  std::string title = manual_name(page);
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
  std::string text = fmt::format(
      ".\\\" Made from the program's own table of options.\n"
      ".TH {} 1 {} \"trisect {}\" \"User Commands\"\n",
      roff(title), date, roff(version));
  text += ".SH NAME\n" + paragraph(manual_name(page) + " - " + page.summary);
  // The usage's first words are the command's, which is typed; the rest stands for something.
  text += ".SH SYNOPSIS\n" + bold(page.path) + roff(page.usage.substr(page.path.size())) + '\n';
  text += ".SH DESCRIPTION\n" + paragraph(sentence(page.summary));
  for (const std::string& more : texts.description) text += ".PP\n" + paragraph(more);
  if (!page.commands.empty()) {
    text += ".SH COMMANDS\n";
    for (const CommandPage& command : page.commands) {
      text += ".TP\n" + reference(command) + '\n' + paragraph(sentence(command.summary));
    }
  }
  text += options_section(page);
  if (!texts.examples.empty()) text += examples_section(texts.examples);
  text += ".SH EXIT STATUS\n" + terms(exit_codes());
  if (is_program) {
    text += ".SH ENVIRONMENT\n" + terms(environment());
    text += ".SH FILES\n" + terms(files());
  }
  // The page above, and those below.
  std::vector<std::string> others;
  for (const CommandPage* other : all_pages(program)) {
    const bool is_above = page.path.starts_with(other->path + ' ');
    const bool is_below = other->path.starts_with(page.path + ' ');
    if (is_above || is_below) others.push_back(reference(*other));
  }
  text += ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < others.size(); ++i) {
    text += others[i] + (i + 1 == others.size() ? "\n" : ",\n");
  }
  return text;
}

}  // namespace trisect
