// Compares our tables of X3D with the standard's own schema.
#include "server/x3d/schema.hpp"

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/source_files.hpp"

namespace mechane::x3d {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

/// The value of an attribute in a line of the standard's schema; empty where the line does not have it.
std::string in_quotes(const std::string& line, const std::string& name) {
  const std::size_t at = line.find(" " + name + "=\"");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + name.size() + 3;
  return line.substr(begin, line.find('"', begin) - begin);
}

TEST(Schema, KnowsEveryElementAndAttributeOfTheStandard) {
  const auto file = test::shared_folder() / "x3d/schema/x3d-4.0.xsd";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the standard's schema is not beside the project";
  const Schema& schema = Schema::standard();
  const NodeType* type = nullptr;
  int types = 0;
  int fields = 0;
  bool formal = false;     // past the annotation, which names fields in the same form
  bool commented = false;  // comments hold nodes of later versions of X3D
  for (const std::string& line : lines_of(test::text_of(file))) {
    if (line.find("<!--") != std::string::npos) commented = true;
    const bool skipped = commented;
    if (line.find("-->") != std::string::npos) commented = false;
    if (skipped) continue;
    if (line.starts_with("  <xs:element name=")) {
      const std::string name = in_quotes(line, "name");
      formal = false;
      type = schema.find(name);
      EXPECT_NE(type, nullptr) << name;
      ++types;
    } else if (line.starts_with("  </xs:element>")) {
      type = nullptr;
    }
    if (line.starts_with("    <xs:complexType")) formal = true;
    if (formal && type != nullptr && line.find("<xs:attribute name=") != std::string::npos) {
      const std::string name = in_quotes(line, "name");
      if (name == "containerField") {
        EXPECT_TRUE(in_quotes(line, "default").empty() || in_quotes(line, "default") == type->container) << type->name;
      } else if (name != "DEF" && name != "USE" && name != "class" && name != "id" && name != "style" &&
                 !name.starts_with("component")) {
        const Field* field = type->field(name);
        EXPECT_NE(field, nullptr) << type->name << "." << name;
        const std::string of = in_quotes(line, "type");
        if (field != nullptr && (of.starts_with("SFV") || of.starts_with("MFV") || of.starts_with("SFR"))) {
          EXPECT_EQ(field->type, of) << type->name << "." << name;
        }
        ++fields;
      }
    }
  }
  EXPECT_GT(types, 250);
  EXPECT_GT(fields, 700);
}

TEST(Schema, EveryDefaultIsAValueOfItsType) {
  const Schema& schema = Schema::standard();
  for (const std::string& name : schema.names()) {
    for (const Field& field : schema.find(name)->fields) {
      if (field.type == "MFString" || (field.default_value.empty() && !field.type.starts_with("MF"))) continue;
      const auto fault = field.fault(field.default_value);
      EXPECT_FALSE(fault) << name << "." << field.name << ": " << fault->what;
    }
  }
}

TEST(Schema, KnowsBasesContainersAndSlots) {
  const Schema& schema = Schema::standard();
  EXPECT_TRUE(schema.is_a("BallJoint", "X3DRigidJointNode"));
  EXPECT_TRUE(schema.is_a("IndexedFaceSet", "X3DGeometryNode"));
  EXPECT_FALSE(schema.is_a("RigidBody", "X3DRigidJointNode"));
  const NodeType* body = schema.find("RigidBody");
  EXPECT_EQ(body->container, "bodies");
  EXPECT_EQ(body->field("mass")->default_value, "1");
  EXPECT_NE(body->field("visible"), nullptr) << "inherited from an interface";
  EXPECT_TRUE(schema.accepts(*body->slot("geometry"), "CollidableShape"));
  EXPECT_FALSE(schema.accepts(*body->slot("geometry"), "Shape"));
  EXPECT_EQ(schema.find("X3DNode"), nullptr) << "abstract types are not elements";
}

}  // namespace
}  // namespace mechane::x3d
