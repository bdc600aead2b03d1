#include "server/x3d/document.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace mechane::x3d {
namespace {

using enum ErrorCode;

constexpr const char* kHead = "<X3D version='4.0'>\n<Scene>\n";
constexpr const char* kTail = "</Scene>\n</X3D>\n";

struct Read {
  Expected<Document> document;
  Problems problems{"test.x3d"};
};

Read read(const std::string& bytes, const DocumentLimits& limits = {}) {
  Read out{fail(ErrorCode::missing, "not read")};
  out.document = read_document(bytes, "test.x3d", out.problems, limits);
  return out;
}

Read read_scene(const std::string& scene, const DocumentLimits& limits = {}) {
  return read(kHead + scene + kTail, limits);
}

/// The first error: its line, its code, and a name or number that it must hold. The document's Error has the same code and line.
void expect_error(const Read& read, int line, ErrorCode code, const std::string& name) {
  ASSERT_FALSE(read.document.has_value()) << "expected: " << name_of(code) << " with " << name;
  const auto first = std::find_if(read.problems.all().begin(), read.problems.all().end(),
                                  [](const Problem& p) { return p.severity == Severity::error; });
  ASSERT_NE(first, read.problems.all().end());
  EXPECT_EQ(first->line, line) << to_string(*first);
  EXPECT_EQ(first->code, code) << name_of(first->code) << " " << to_string(*first);
  EXPECT_EQ(read.document.error().line, line);
  EXPECT_EQ(read.document.error().code, code);
  EXPECT_NE(to_string(*first).find(name), std::string::npos) << to_string(*first);
  EXPECT_FALSE(first->remedy.empty());
}

TEST(Document, KeepsEverythingInOrderWithLines) {
  const Read r = read(
      "<?xml version='1.0'?>\n<!DOCTYPE X3D PUBLIC 'a' 'b'>\n<X3D version='4.0'><!-- one -->\n<Scene>\n"
      "<Unheard DEF='U' odd='1'>text<![CDATA[raw]]></Unheard>\n<Group USE='G'/><Group DEF='G'/></Scene></X3D>");
  ASSERT_TRUE(r.document) << r.document.error().to_string();
  const Document& d = *r.document;
  EXPECT_EQ(d[d.x3d()].line, 3);
  const NodeId unheard = d.find_def("U");
  EXPECT_EQ(d[unheard].line, 5);
  EXPECT_EQ(*d[unheard].attribute("odd"), "1");
  ASSERT_EQ(d[unheard].children.size(), 1u);
  EXPECT_EQ(d[d[unheard].children[0]].kind, NodeKind::text);
  EXPECT_EQ(d[d[unheard].children[0]].text, "textraw");
  // A USE before its DEF is resolved, with a warning: other readers do not find it.
  EXPECT_EQ(d.resolve(d.child_elements(d.scene())[1]), d.find_def("G"));
  ASSERT_EQ(r.problems.all().size(), 1u);
  EXPECT_EQ(r.problems.all()[0].severity, Severity::warning);
  EXPECT_EQ(r.problems.all()[0].code, conflict);
  EXPECT_EQ(r.problems.all()[0].line, 6);
}

TEST(Document, DeepNestingIsAnErrorAndNotACrash) {
  constexpr int kDeep = 100'000;
  std::string scene;
  for (int i = 0; i < kDeep; ++i)
    scene += "<Group>\n";
  for (int i = 0; i < kDeep; ++i)
    scene += "</Group>";
  expect_error(read_scene(scene), 201, too_large, "200");
}

TEST(Document, UnclosedDeepNestingIsAnError) {
  std::string scene;
  for (int i = 0; i < 100'000; ++i)
    scene += "<Group>";
  const Read r = read(kHead + scene);
  ASSERT_FALSE(r.document);
  expect_error(r, 3, too_large, "200");
}

TEST(Document, CapsOnSizeCountAndMetadata) {
  expect_error(read_scene(std::string(3000, ' '), {.bytes = 2000}), 0, too_large, "MB");
  std::string many;
  for (int i = 0; i < 120; ++i)
    many += "<a/>\n";
  expect_error(read_scene(many, {.nodes = 100}), 101, too_large, "100");
  expect_error(read_scene(many + many + many, {.nodes = 100}), 0, too_large, "100");
  const std::string metadata = "<MetadataString name='m' value='\"" + std::string(600, 'x') + "\"'/>\n";
  expect_error(read_scene(metadata + metadata, {.metadata_bytes = 1000}), 4, too_large, "MetadataString");
}

TEST(Document, CirclesOfUse) {
  expect_error(read_scene("<Group DEF='A'>\n<Group USE='A'/></Group>\n"), 4, conflict, "(line 3)");
  expect_error(read_scene("<Group DEF='A'>\n<Group USE='B'/></Group>\n<Group DEF='B'>\n<Group USE='A'/></Group>\n"), 6,
               conflict, "(line 3)");
}

TEST(Document, NamesThatDoNotFit) {
  expect_error(read_scene("<RigidBody DEF='INNER'/>\n<RigidBody USE='INER'/>\n"), 4, unknown_name,
               "did you mean 'INNER'?");
  expect_error(read_scene("<RigidBody DEF='A'/>\n<Group DEF='A'/>\n"), 4, duplicate, "line 3");
  expect_error(read_scene("<RigidBody DEF='A'/>\n<Group USE='A'/>\n"), 4, conflict, "RigidBody (line 3)");
  // A prototype's body has its own names.
  EXPECT_TRUE(
      read_scene("<ProtoDeclare name='P'><ProtoBody><Group DEF='A'/></ProtoBody></ProtoDeclare><Group DEF='A'/>")
          .document);
}

TEST(Document, WhatIsNotX3D) {
  expect_error(read(""), 0, damaged, "empty");
  expect_error(read("<html/>"), 1, invalid_value, "html");
  expect_error(read("<X3D version='4.0'/>"), 1, ErrorCode::missing, "Scene");
  expect_error(read("<X3D version='5.0'>\n<Scene/></X3D>"), 1, wrong_version, "'5.0'");
  expect_error(read("<X3D version='4.0'><Scene>\n<Group></Scene></X3D>"), 2, damaged, "</Scene>");
  expect_error(read_scene("\n<Group DEF='\xff'/>"), 4, damaged, "UTF-8");
  expect_error(read_scene(std::string("\n<Group/>\0", 10)), 4, damaged, "UTF-8");
  expect_error(read("<!DOCTYPE X3D [\n<!ENTITY a SYSTEM 'file:///etc/passwd'>]>\n<X3D version='4.0'><Scene/></X3D>"), 2,
               not_supported, "<!ENTITY");
}

TEST(Document, ADoctypeThatOnlyNamesX3dIsIgnored) {
  const std::string doctype =
      "<?xml version='1.0' encoding='UTF-8'?>\n"
      "<!DOCTYPE X3D PUBLIC \"ISO//Web3D//DTD X3D 4.0//EN\" \"https://www.web3d.org/specifications/x3d-4.0.dtd\">\n";
  const Read r = read("\xEF\xBB\xBF" + doctype + "<X3D version='4.0'><Scene><Group DEF='A'/></Scene></X3D>\n");
  ASSERT_TRUE(r.document) << r.document.error().to_string();
  EXPECT_EQ((*r.document)[r.document->find_def("A")].line, 3);
  // The named file is never read, so entities that it may declare are not known.
  expect_error(read(doctype + "<X3D version='4.0'>\n<Scene><Group DEF='&far;'/></Scene></X3D>"), 4, damaged, "&far;");
  expect_error(read(doctype + "<X3D version='4.0'>\n<Scene>\n&far;</Scene></X3D>"), 5, damaged, "&far;");
}

TEST(Document, NothingIsDeclaredInADoctype) {
  const std::string scene = "<X3D version='4.0'><Scene>&a;&a;</Scene></X3D>";
  const auto with = [&](const std::string& declared) { return read("<!DOCTYPE X3D [\n" + declared + "\n]>" + scene); };
  expect_error(with("<!ENTITY a 'x'>"), 2, not_supported, "<!ENTITY");
  expect_error(with("<!ENTITY % p 'x'>\n%p;"), 2, not_supported, "<!ENTITY");
  expect_error(with("<!-- ha -->\n<!ATTLIST Group DEF CDATA 'A'>"), 3, not_supported, "<!ATTLIST");
  expect_error(with("%p;\n<!ENTITY a 'x'>"), 4, damaged, "&a;");
  expect_error(with(""), 3, damaged, "&a;");
  expect_error(read("<!DOCTYPE X3D [\n<!ENTITY"), 1, damaged, "DOCTYPE");
  expect_error(read("<!DOCTYPE X3D\n"), 1, damaged, "write >");
}

TEST(Document, FaultsThatOnlyTheParserFinds) {
  expect_error(read_scene("a\n]]>"), 4, damaged, "]]&gt;");
  expect_error(read_scene("\n<Group DEF='\x01'/>"), 4, damaged, "0x01");
  expect_error(read_scene("\n<Group DEF='&#0;'/>"), 4, damaged, "invalid character number");
  expect_error(read("\n<?xml version='1.0'?><X3D version='4.0'><Scene/></X3D>"), 2, damaged, "<?xml ...?>");
  expect_error(read("<!-- nothing -->"), 1, ErrorCode::missing, "<X3D");
  expect_error(read("words"), 1, damaged, "outermost");
}

TEST(Document, PlacesAreThoseOfTheText) {
  const std::string scene =
      "<Group\r\n DEF = \"A&amp;&#x3b1;\"\tbboxSize='1 2\r\n3'>one &lt; <!-- > --> two<Group/></Group >";
  const Read r = read_scene(scene);
  ASSERT_TRUE(r.document) << r.document.error().to_string();
  const Document& d = *r.document;
  const std::string& text = d.source();
  const Node& group = d[d.find_def("A&\xce\xb1")];
  EXPECT_EQ(group.line, 3);
  EXPECT_EQ(text.substr(group.span.begin, group.span.end - group.span.begin), scene);
  EXPECT_TRUE(text.substr(group.span.tag_end).starts_with("one"));
  EXPECT_TRUE(text.substr(group.span.inner_end).starts_with("</Group >"));
  ASSERT_EQ(group.attributes.size(), 2u);
  EXPECT_EQ(group.attributes[1].value, "1 2 3");
  const AttributeSpan& span = group.attributes[1].span;
  EXPECT_EQ(text.substr(span.begin, span.name_end - span.begin), "bboxSize");
  EXPECT_EQ(text.substr(span.value_begin, span.value_end - span.value_begin), "1 2\r\n3");
  ASSERT_EQ(group.children.size(), 2u);
  EXPECT_EQ(d[group.children[0]].text, "one <  two");
  const Node& inner = d[group.children[1]];
  EXPECT_EQ(text.substr(inner.span.begin, inner.span.end - inner.span.begin), "<Group/>");
  EXPECT_EQ(inner.span.tag_end, inner.span.end);
  EXPECT_EQ(inner.span.inner_end, inner.span.end);
}

TEST(Document, FilesThatCannotBeRead) {
  Problems problems("x");
  EXPECT_FALSE(read_document(std::filesystem::path("/nowhere/at-all.x3d"), problems));
  EXPECT_FALSE(read_document(std::filesystem::temp_directory_path(), problems));
  EXPECT_FALSE(read_document(std::filesystem::path("/dev/zero"), problems));
  ASSERT_EQ(problems.all().size(), 3u);
  EXPECT_EQ(problems.all()[0].code, not_found);
  EXPECT_EQ(problems.all()[1].code, io_failure);
  EXPECT_EQ(problems.all()[2].code, io_failure);
  for (const Problem& p : problems.all())
    EXPECT_FALSE(p.remedy.empty());
}

}  // namespace
}  // namespace mechane::x3d
