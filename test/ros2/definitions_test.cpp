#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

// The messages as TERA puts them on the wire, against ROS 2's own definitions.

namespace tera {
namespace {

/// "float64[9] k", as ROS 2 writes a field, in a message's order; by "package/Message".
using Definitions = std::map<std::string, std::vector<std::string>>;

std::string Read(const std::string& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

Definitions Upstream() {
  std::istringstream lines(Read("test/ros2/data/humble_messages.txt"));
  Definitions definitions;
  std::string message, line;
  while (std::getline(lines, line)) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] != ' ') {
      message = line;
    } else {
      definitions[message].push_back(line.substr(line.find_first_not_of(' ')));
    }
  }
  return definitions;
}

/// ROS 2's name of an IDL type within a package.
std::string RosType(const std::string& idl, const std::string& package) {
  static const std::map<std::string, std::string> kPlain = {{"long", "int32"},
                                                            {"unsigned long", "uint32"},
                                                            {"unsigned short", "uint16"},
                                                            {"octet", "uint8"},
                                                            {"int8", "int8"},
                                                            {"boolean", "bool"},
                                                            {"float", "float32"},
                                                            {"double", "float64"},
                                                            {"string", "string"}};
  std::smatch part;
  if (std::regex_match(idl, part, std::regex("sequence<(.*)>"))) {
    return RosType(part[1], package) + "[]";
  }
  const auto plain = kPlain.find(idl);
  if (plain != kPlain.end()) return plain->second;
  if (std::regex_match(idl, part, std::regex("(\\w+)::msg::dds_::(\\w+)_"))) {
    return part[1].str() + "/" + part[2].str();
  }
  return package + "/" + idl.substr(0, idl.size() - 1);
}

Definitions OnTheWire() {
  const std::string text =
      std::regex_replace(Read("src/ros2/topic_types.idl"), std::regex("//[^\n]*"), "");
  Definitions definitions;
  std::string package;
  const std::regex piece("module (\\w+) \\{ module msg|struct (\\w+)_ \\{([^}]*)\\}");
  for (std::sregex_iterator it(text.begin(), text.end(), piece), end; it != end; ++it) {
    if ((*it)[1].matched) {
      package = (*it)[1];
      continue;
    }
    std::vector<std::string>& fields = definitions[package + "/" + (*it)[2].str()];
    const std::string body = (*it)[3];
    const std::regex field("([\\w:<> ]*[\\w>])\\s+(\\w+)(\\[\\d+\\])?;");
    for (std::sregex_iterator f(body.begin(), body.end(), field); f != end; ++f) {
      const std::string type = std::regex_replace((*f)[1].str(), std::regex("^\\s+"), "");
      fields.push_back(RosType(type, package) + (*f)[3].str() + " " + (*f)[2].str());
    }
  }
  return definitions;
}

TEST(RosDefinitions, OfEveryMessageAreThoseOfRos2Humble) {
  const Definitions upstream = Upstream();
  EXPECT_EQ(upstream.size(), 25u);
  Definitions wire = OnTheWire();
  ASSERT_EQ(wire.erase("tera_msgs/DeltaCAN"), 1u);  // TERA's own
  for (const auto& [message, fields] : wire) {
    const auto same = upstream.find(message);
    ASSERT_NE(same, upstream.end()) << message;
    EXPECT_EQ(fields, same->second) << message;
  }
  EXPECT_EQ(wire.size(), upstream.size());
}

TEST(RosDefinitions, OfTheLeverMessageAreThoseThatAreShippedForRos2) {
  std::istringstream lines(Read("examples/ros2/tera_msgs/msg/DeltaCAN.msg"));
  std::vector<std::string> fields;
  const std::regex field("^(\\S+) ([a-z_]+)\\s*(#.*)?$");
  std::smatch part;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_match(line, part, field)) continue;
    fields.push_back(part[1].str() + " " + part[2].str());
  }
  EXPECT_EQ(fields.size(), 13u);
  EXPECT_EQ(OnTheWire()["tera_msgs/DeltaCAN"], fields);
}

}  // namespace
}  // namespace tera
