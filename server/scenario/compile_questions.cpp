// Reads the questionnaire of an activity.
#include <algorithm>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

using Question = state::QuestionDescription;

void read_choice(Compilation& c, const Fields& fields, std::map<std::string, state::Texts>& texts, Question& out) {
  const std::vector<std::string> names = fields.strings("answers");
  for (const std::string& name : names)
    out.answers.push_back({name, texts["answer:" + name]});
  out.correct = fields.string("correct");
  if (fields.given("correct") && std::find(names.begin(), names.end(), out.correct) == names.end()) {
    report_unknown(c, {fields.where(), fields.line("correct")}, "answer", out.correct, names, "add it to the answers");
  }
  if (fields.given("steps"))
    c.problems.warning(ErrorCode::conflict, fields.line("steps"), fields.where(), "a choice does not use 'steps'",
                       "remove it");
}

void read_scale(Compilation& c, const Fields& fields, std::map<std::string, state::Texts>& texts, Question& out) {
  out.marks = static_cast<int>(fields.number("steps"));
  if (out.marks != fields.number("steps"))
    c.problems.error(ErrorCode::invalid_value, fields.line("steps"), fields.where(),
                     "the number of marks on a scale is not whole", "write a whole number, like 5");
  out.low = texts["low"];
  out.high = texts["high"];
  for (const char* key : {"answers", "correct"}) {
    if (fields.given(key))
      c.problems.warning(ErrorCode::conflict, fields.line(key), fields.where(),
                         fmt::format("a scale does not use '{}'", key), "remove it");
  }
}

Question read_question(Compilation& c, const x3d::Metadata& set, const std::string& activity) {
  const Fields fields(&set, question_table(), fmt::format("{}, question {}", activity, set.name), c.problems);
  Question out;
  out.name = set.name;
  if (!fields.given("kind") || fields.has_faults())
    return out;  // the other keys depend on the kind, the texts on the answers
  out.kind = fields.string("kind") == "scale" ? Question::Kind::scale : Question::Kind::choice;
  if (out.kind == Question::Kind::choice && fields.strings("answers").size() < 2) {
    c.problems.error(ErrorCode::missing, fields.line("answers"), fields.where(), "a choice needs two answers or more",
                     "name them in the key answers, each in its own quotes, like \"pitch\" \"speed\"");
    return out;
  }
  std::string allowed = out.kind == Question::Kind::scale ? "question low high" : "question";
  if (out.kind == Question::Kind::choice) {
    for (const std::string& answer : fields.strings("answers"))
      allowed += " answer:" + answer;
  }
  auto texts = read_texts(c, fields.set("text"), fields.where() + ", text", allowed);
  out.question = texts["question"];
  if (out.kind == Question::Kind::scale) {
    read_scale(c, fields, texts, out);
  } else {
    read_choice(c, fields, texts, out);
  }
  return out;
}

}  // namespace

std::vector<Question> read_questionnaire(Compilation& c, const Fields& activity) {
  std::vector<Question> questions;
  std::vector<int>& lines = c.question_lines.emplace_back();
  const x3d::Metadata* tree = activity.set("questionnaire");
  if (tree == nullptr) return questions;
  for (const x3d::Metadata& set : tree->children) {
    if (set.kind != x3d::MetadataKind::set) {
      c.problems.error(ErrorCode::invalid_value, set.line, activity.where(),
                       fmt::format("the question '{}' is not a set", set.name), "write a MetadataSet");
    } else {
      questions.push_back(read_question(c, set, activity.where()));
      lines.push_back(set.line);
    }
  }
  return questions;
}

}  // namespace mechane::scenario
