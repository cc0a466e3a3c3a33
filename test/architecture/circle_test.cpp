#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "architecture/source_includes.h"

// A header and the source of the same name are one part. Parts include each other in one direction,
// so that a change's reach is known. Code shared by two parts has its own header.

namespace {

using testing_architecture::AllIncludes;
using testing_architecture::Include;
using testing_architecture::IncludesOf;

using Parts = std::map<std::string, std::set<std::string>>;  ///< includes of each part

std::string PartOf(const std::string& file) { return file.substr(0, file.rfind('.')); }

Parts PartsOf(const std::vector<Include>& includes) {
  Parts parts;
  for (const Include& include : includes) parts[PartOf(include.file)];
  for (const Include& include : includes) {
    const std::string part = PartOf(include.file), other = PartOf(include.header);
    if (part != other && parts.contains(other)) parts[part].insert(other);
  }
  return parts;
}

/// Walks from part to part; a repeated part closes a circle.
class Walk {
 public:
  explicit Walk(const Parts& parts) : parts_(parts) {
    for (const auto& [part, _] : parts) From(part);
  }
  /// One entry for each circle, "a > b > a".
  const std::vector<std::string>& circles() const { return circles_; }

 private:
  void From(const std::string& part) {
    const auto met = std::find(way_.begin(), way_.end(), part);
    if (met != way_.end()) {
      std::string circle;
      for (auto step = met; step != way_.end(); ++step) circle += *step + " > ";
      circles_.push_back(circle + part);
      return;
    }
    if (!walked_.insert(part).second) return;
    way_.push_back(part);
    for (const std::string& other : parts_.at(part)) From(other);
    way_.pop_back();
  }

  const Parts& parts_;
  std::vector<std::string> way_, circles_;
  std::set<std::string> walked_;
};

std::vector<std::string> Circles(const std::vector<Include>& includes) {
  const Parts parts = PartsOf(includes);
  return Walk(parts).circles();
}

/// The room of a file: its folder within one of the folders of src/. Empty for a file directly in
/// such a folder, which may include any room and be included by any.
std::string RoomOf(const std::string& file) {
  const std::size_t folder = file.find('/');
  const std::size_t room = folder == file.npos ? file.npos : file.find('/', folder + 1);
  return room == file.npos ? "" : file.substr(0, room);
}

/// The circles among the rooms of `folder`.
std::vector<std::string> CirclesOfRooms(const std::vector<Include>& includes,
                                        const std::string& folder) {
  Parts rooms;
  for (const Include& include : includes) {
    const std::string room = RoomOf(include.file), other = RoomOf(include.header);
    if (include.folder != folder || room.empty()) continue;
    rooms[room];
    if (other.starts_with(folder + "/") && other != room) rooms[room].insert(other);
  }
  for (const auto& [_, others] : Parts(rooms)) {
    for (const std::string& other : others) rooms[other];
  }
  return Walk(rooms).circles();
}

/// The includes of several files, each of one header.
std::vector<Include> Sources(const std::vector<std::pair<std::string, std::string>>& lines) {
  std::vector<Include> includes;
  for (const auto& [file, header] : lines) {
    const auto some = IncludesOf(file, header);
    includes.insert(includes.end(), some.begin(), some.end());
  }
  return includes;
}

TEST(Circles, AreNotAmongThePartsOfTheSources) {
  const std::vector<Include> includes = AllIncludes();
  const Parts parts = PartsOf(includes);
  ASSERT_GT(parts.size(), 100u);
  ASSERT_TRUE(parts.contains("blind/plant/plant"));
  for (const std::string& circle : Circles(includes)) ADD_FAILURE() << circle;
}

TEST(Circles, AreFoundThroughASourceAndAnotherHeader) {
  EXPECT_EQ(Circles(Sources({{"soil/bed.h", "soil/flow.h"},
                             {"soil/flow.cpp", "soil/grain.h"},
                             {"soil/grain.h", "soil/bed.h"}})),
            std::vector<std::string>{"soil/bed > soil/flow > soil/grain > soil/bed"});
}

TEST(Circles, AreNotSeenWhereTwoPartsShareALeaf) {
  EXPECT_TRUE(Circles(Sources({{"soil/bed.h", "soil/grain.h"},
                               {"soil/bed.cpp", "soil/bed.h"},
                               {"soil/flow.cpp", "soil/bed.h"},
                               {"soil/flow.h", "soil/grain.h"},
                               {"soil/grain.h", "vector"}}))
                  .empty());
}

TEST(Circles, AreNotAmongTheRoomsOfAFolder) {
  const std::vector<Include> includes = AllIncludes();
  for (const char* folder : {"app", "blind", "core", "dataset", "layout", "resimulate", "ros2",
                             "sensors", "serve", "sim", "survey", "view"}) {
    for (const std::string& circle : CirclesOfRooms(includes, folder)) ADD_FAILURE() << circle;
  }
}

TEST(Circles, AreFoundAmongRoomsWhosePartsHaveNone) {
  const auto sources = Sources({{"soil/bed/bed.h", "soil/flow/grain.h"},
                                {"soil/flow/flow.cpp", "soil/bed/layer.h"},
                                {"soil/flow/grain.h", "vector"},
                                {"soil/bed/layer.h", "vector"},
                                {"soil/soil.cpp", "soil/bed/bed.h"}});
  EXPECT_TRUE(Circles(sources).empty());
  EXPECT_EQ(CirclesOfRooms(sources, "soil"),
            std::vector<std::string>{"soil/bed > soil/flow > soil/bed"});
}

}  // namespace
