#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "architecture/source_includes.h"

// Checks every #include line under src/ and blind/ against the architecture: visibility between
// folders, the single folder of each third-party library, and the contents of public headers.

namespace {

namespace fs = std::filesystem;

using testing_architecture::AllIncludes;
using testing_architecture::Include;
using testing_architecture::IncludesOf;

const std::map<std::string, std::set<std::string>> kMaySee = {
    {"core", {}},
    {"blind", {"core"}},
    {"physics", {"core"}},
    {"soil", {"core"}},
    {"render", {"core"}},
    {"dataset", {"core"}},
    {"sensors", {"core", "physics", "render", "dataset"}},
    {"sim", {"core", "physics", "soil", "render", "dataset", "sensors"}},
    {"resimulate", {"core", "physics", "soil", "render", "dataset", "sensors", "sim"}},
    {"diagnose", {"core", "physics", "soil", "render", "dataset", "sensors", "sim", "resimulate"}},
    {"layout", {"core", "physics", "soil", "render", "dataset", "sensors", "sim", "resimulate"}},
    {"campaign", {"core", "physics", "soil", "render", "dataset", "sensors", "sim"}},
    {"survey", {"core", "soil", "dataset"}},
    {"serve", {"core", "physics", "soil", "render", "dataset", "sensors", "sim"}},
    {"ros2", {"core", "physics", "soil", "render", "dataset", "sensors", "sim"}},
    {"view", {"core", "dataset"}},
    {"app",
     {"core", "physics", "soil", "render", "dataset", "sensors", "sim", "resimulate", "diagnose",
      "layout", "campaign", "survey", "serve", "ros2", "view", "blind"}},
};

/// Headers of a library by their beginning, and the folders that may include them. A header that is
/// neither listed nor free is a fault, so that every new library is listed.
const std::multimap<std::string, std::string> kFolderOfLibrary = {
    {"yaml-cpp/", "core"},
    {"Random123/", "core"},
    {"immintrin.h", "core"},
    {"BulletCollision/", "physics"},
    {"BulletDynamics/", "physics"},
    {"LinearMath/", "physics"},
    {"console_bridge/", "physics"},
    {"urdf_model/", "physics"},
    {"urdf_parser/", "physics"},
    {"tinyxml2.h", "physics"},
    {"gdal_priv.h", "soil"},
    {"ogr_spatialref.h", "soil"},
    {"assimp/", "render"},
    {"tiny_gltf.h", "render"},
    {"epoxy/", "render"},
    {"embree3/", "render"},
    {"GeographicLib/", "dataset"},
    {"opencv2/", "dataset"},
    {"opencv2/", "sensors"},
    {"liblzf/", "dataset"},
    {"nlohmann/", "dataset"},
    {"nlohmann/", "diagnose"},
    {"nlohmann/", "layout"},
    {"nlohmann/", "survey"},
    {"pcl/", "survey"},
    {"nlohmann/", "view"},
    {"httplib.h", "view"},
    {"boost/math/", "diagnose"},
    {"boost/math/", "layout"},
    {"boost/math/", "campaign"},
    {"boost/random/", "campaign"},
    {"nlohmann/", "campaign"},
    {"boost/math/", "sim"},
    {"ceres/", "diagnose"},
    {"openssl/", "dataset"},
    {"libdeflate.h", "dataset"},
    {"lz4frame.h", "dataset"},
    {"pcap/", "dataset"},
    {"bzlib.h", "dataset"},
    {"libnova/", "sim"},
    {"sqlite3.h", "campaign"},
    {"sqlite3.h", "dataset"},
    {"zlib.h", "dataset"},
    {"zstd.h", "dataset"},
    {"pagmo/", "layout"},
    {"CLI/", "app"},
    {"cvode/", "blind"},
    {"mujoco/", "blind"},
    {"nvector/", "blind"},
    {"sunlinsol/", "blind"},
    {"sunmatrix/", "blind"},
    {"yaml-cpp/", "blind"},
    {"nlohmann/", "blind"},
    {"openssl/", "blind"},
    {"grpcpp/", "serve"},
    {"google/protobuf/", "serve"},
    {"tera/v1/", "serve"},
    {"dds/", "ros2"},
};

/// Names of libraries in docs/architecture.md, by the beginning of their headers.
const std::map<std::string, std::string> kNameOfLibrary = {
    {"BulletCollision/", "Bullet"},
    {"BulletDynamics/", "Bullet"},
    {"CLI/", "CLI11"},
    {"GeographicLib/", "GeographicLib"},
    {"LinearMath/", "Bullet"},
    {"Random123/", "Random123"},
    {"assimp/", "assimp"},
    {"boost/math/", "Boost.Math"},
    {"boost/random/", "Boost.Random"},
    {"bzlib.h", "libbz2"},
    {"ceres/", "Ceres"},
    {"console_bridge/", "urdfdom"},
    {"cvode/", "SUNDIALS"},
    {"dds/", "Cyclone DDS"},
    {"embree3/", "Embree"},
    {"epoxy/", "EGL/OpenGL"},
    {"gdal_priv.h", "GDAL"},
    {"google/protobuf/", "protobuf"},
    {"grpcpp/", "gRPC"},
    {"httplib.h", "cpp-httplib"},
    {"immintrin.h", "immintrin.h"},
    {"libdeflate.h", "libdeflate"},
    {"liblzf/", "liblzf"},
    {"libnova/", "libnova"},
    {"lz4frame.h", "liblz4"},
    {"mujoco/", "MuJoCo"},
    {"nlohmann/", "nlohmann/json"},
    {"nvector/", "SUNDIALS"},
    {"ogr_spatialref.h", "GDAL"},
    {"opencv2/", "OpenCV"},
    {"openssl/", "OpenSSL"},
    {"pagmo/", "pagmo"},
    {"pcap/", "libpcap"},
    {"pcl/", "PCL"},
    {"sqlite3.h", "SQLite"},
    {"sunlinsol/", "SUNDIALS"},
    {"sunmatrix/", "SUNDIALS"},
    {"tera/v1/", "protobuf"},
    {"tiny_gltf.h", "tinygltf"},
    {"tinyxml2.h", "TinyXML-2"},
    {"topic_types.h", "Cyclone DDS"},
    {"urdf_model/", "urdfdom"},
    {"urdf_parser/", "urdfdom"},
    {"yaml-cpp/", "yaml-cpp"},
    {"zlib.h", "zlib"},
    {"zstd.h", "libzstd"},
};

using LibrariesOfFolders = std::map<std::string, std::set<std::string>>;

/// The libraries that folders include, by their names.
LibrariesOfFolders LibrariesOf(const std::vector<Include>& includes) {
  LibrariesOfFolders libraries;
  for (const Include& include : includes) {
    for (const auto& [beginning, name] : kNameOfLibrary) {
      if (include.header.starts_with(beginning)) libraries[include.folder].insert(name);
    }
  }
  return libraries;
}

/// The last column of the page's table of folders, without parts in brackets.
LibrariesOfFolders LibrariesOfThePage() {
  LibrariesOfFolders libraries;
  const std::regex row_form(R"(^\| (?:src/)?(\w+) \|.*\| ([^|]*)\|$)"), name_form("[^,;]*[^,; ]");
  const std::regex brackets(R"( \([^)]*\))");
  std::ifstream page("docs/architecture.md");
  std::smatch row;
  for (std::string line; std::getline(page, line);) {
    if (!std::regex_search(line, row, row_form) || !kMaySee.contains(row[1])) continue;
    const std::string names = std::regex_replace(row[2].str(), brackets, "");
    for (std::sregex_iterator name(names.begin(), names.end(), name_form), end; name != end;
         ++name) {
      const std::string text = name->str();
      libraries[row[1]].insert(text.substr(text.find_first_not_of(' ')));
    }
  }
  return libraries;
}

bool MayInclude(const std::string& folder, const std::string& library) {
  const auto [first, last] = kFolderOfLibrary.equal_range(library);
  return std::any_of(first, last, [&](const auto& entry) { return entry.second == folder; });
}

/// Headers of the operating system.
const std::set<std::string> kPosix = {"fcntl.h",        "poll.h",      "spawn.h",
                                      "sys/file.h",     "sys/ioctl.h", "sys/prctl.h",
                                      "sys/resource.h", "sys/wait.h",  "unistd.h"};

bool IsStandard(const std::string& header) {
  return header.find_first_of("/.") == std::string::npos;
}

bool IsFree(const std::string& header) {
  return IsStandard(header) || header.starts_with("Eigen/") || header.starts_with("fmt/");
}

bool IsOurs(const std::string& header) {
  return kMaySee.contains(header.substr(0, header.find('/'))) && header.ends_with(".h");
}

const std::set<std::string>& InternalHeaders() {
  static const std::set<std::string> headers = [] {
    std::set<std::string> lines;
    std::ifstream list("cmake/internal_headers.txt");
    for (std::string line; std::getline(list, line);) {
      if (!line.starts_with("#")) lines.insert(line);
    }
    return lines;
  }();
  return headers;
}

/// False for the program's own folders, which are not installed: app/ and blind/.
bool IsPublic(const std::string& file) {
  return file.ends_with(".h") && !file.starts_with("app/") && !file.starts_with("blind/") &&
         !InternalHeaders().contains(file);
}

// Violations of each rule.

std::vector<Include> AgainstTheArrows(const std::vector<Include>& includes) {
  std::vector<Include> faults;
  for (const Include& include : includes) {
    const std::string target = include.header.substr(0, include.header.find('/'));
    if (!IsOurs(include.header) || target == include.folder) continue;
    const auto seen = kMaySee.find(include.folder);
    if (seen == kMaySee.end() || !seen->second.contains(target)) faults.push_back(include);
  }
  return faults;
}

std::vector<Include> LibrariesOutOfTheirFolder(const std::vector<Include>& includes) {
  std::vector<Include> faults;
  for (const Include& include : includes) {
    const std::string& header = include.header;
    if (IsFree(header) || IsOurs(header) || kPosix.contains(header)) continue;
    const bool allowed =
        std::any_of(kFolderOfLibrary.begin(), kFolderOfLibrary.end(), [&](const auto& library) {
          return header.starts_with(library.first) && include.folder == library.second;
        });
    if (!allowed) faults.push_back(include);
  }
  return faults;
}

std::vector<Include> WhatPublicHeadersMayNotShow(const std::vector<Include>& includes) {
  std::vector<Include> faults;
  for (const Include& include : includes) {
    if (!IsPublic(include.file)) continue;
    if (!IsFree(include.header) && !IsPublic(include.header)) faults.push_back(include);
    if (!IsFree(include.header) && !IsOurs(include.header)) faults.push_back(include);
  }
  return faults;
}

std::vector<Include> InternalHeadersOutOfTheirFolder(const std::vector<Include>& includes) {
  std::vector<Include> faults;
  for (const Include& include : includes) {
    if (InternalHeaders().contains(include.header) &&
        !include.header.starts_with(include.folder + "/")) {
      faults.push_back(include);
    }
  }
  return faults;
}

/// A replay runs actuation and traction without a multibody.
std::vector<Include> WhatActuationMayNotSee(const std::vector<Include>& includes) {
  const auto is_of_the_chain = [](const std::string& name) {
    return name.starts_with("physics/actuation/") || name.starts_with("physics/traction/");
  };
  std::vector<Include> faults;
  for (const Include& include : includes) {
    if (!is_of_the_chain(include.file)) continue;
    const bool allowed = IsFree(include.header) || include.header.starts_with("core/") ||
                         is_of_the_chain(include.header) ||
                         include.header == "physics/description/machine.h";
    if (!allowed) faults.push_back(include);
  }
  return faults;
}

/// Plain series in, numbers out.
std::vector<Include> WhatStatisticsMayNotSee(const std::vector<Include>& includes) {
  std::vector<Include> faults;
  for (const Include& include : includes) {
    if (!include.file.starts_with("diagnose/statistics/") || !IsOurs(include.header)) continue;
    const bool allowed =
        include.header.starts_with("core/") || include.header.starts_with("diagnose/statistics/");
    if (!allowed) faults.push_back(include);
  }
  return faults;
}

void ExpectNone(const std::vector<Include>& faults) {
  for (const Include& fault : faults) ADD_FAILURE() << fault.Text();
}

TEST(Includes, FollowTheArrowsBetweenFolders) {
  const auto includes = AllIncludes();
  ASSERT_GT(includes.size(), 100u);
  ExpectNone(AgainstTheArrows(includes));
  EXPECT_EQ(AgainstTheArrows(IncludesOf("core/time.h", "sim/rig.h")).size(), 1u);
  EXPECT_EQ(AgainstTheArrows(IncludesOf("soil/soil.cpp", "physics/description/machine.h")).size(),
            1u);
  EXPECT_EQ(AgainstTheArrows(IncludesOf("resimulate/scan_caster.h", "diagnose/diagnosis.h")).size(),
            1u);
  EXPECT_EQ(AgainstTheArrows(IncludesOf("render/lens.cpp", "sensors/camera.h")).size(), 1u);
  EXPECT_EQ(AgainstTheArrows(IncludesOf("blind/plant/plant.h", "sim/rig.h")).size(), 1u);
  EXPECT_EQ(AgainstTheArrows(IncludesOf("diagnose/diagnosis.h", "blind/prove.h")).size(), 1u);
}

TEST(Includes, KeepEachLibraryInItsFolder) {
  ExpectNone(LibrariesOutOfTheirFolder(AllIncludes()));
  for (const auto& [library, _] : kFolderOfLibrary) {
    const std::string header = library.ends_with("/") ? library + "any.h" : library;
    for (const auto& [other, seen] : kMaySee) {
      EXPECT_EQ(LibrariesOutOfTheirFolder(IncludesOf(other + "/any.cpp", header)).empty(),
                MayInclude(other, library))
          << header << " in " << other;
    }
  }
  EXPECT_EQ(LibrariesOutOfTheirFolder(IncludesOf("core/csv.cpp", "boost/any.hpp")).size(), 1u);
}

TEST(Includes, AreOfTheLibrariesThatThePageOfTheArchitectureNames) {
  const LibrariesOfFolders named = LibrariesOfThePage(), included = LibrariesOf(AllIncludes());
  for (const auto& [folder, _] : kMaySee) {
    const auto of = [&](const LibrariesOfFolders& all) {
      return all.contains(folder) ? all.at(folder) : std::set<std::string>();
    };
    EXPECT_EQ(of(named), of(included)) << folder;
  }
  for (const auto& [library, folder] : kFolderOfLibrary) {
    ASSERT_TRUE(kNameOfLibrary.contains(library)) << library;
    EXPECT_TRUE(included.at(folder).contains(kNameOfLibrary.at(library))) << folder << library;
  }
}

TEST(Includes, KeepThirdPartyLibrariesOutOfPublicHeaders) {
  ExpectNone(WhatPublicHeadersMayNotShow(AllIncludes()));
  const auto shows = [](const std::string& header) {
    return !WhatPublicHeadersMayNotShow(IncludesOf("render/gl/rasterizer.h", header)).empty();
  };
  for (const auto& [library, folder] : kFolderOfLibrary) EXPECT_TRUE(shows(library + "any.h"));
  EXPECT_TRUE(shows("render/rays/embree_objects.h"));
  EXPECT_TRUE(shows("unistd.h"));
  EXPECT_FALSE(shows("render/scene.h"));
  EXPECT_FALSE(shows("Eigen/Geometry"));
  EXPECT_FALSE(shows("vector"));
}

TEST(Includes, KeepInternalHeadersInTheirFolder) {
  ASSERT_GT(InternalHeaders().size(), 10u);
  for (const std::string& header : InternalHeaders()) {
    EXPECT_TRUE(fs::exists("src/" + header)) << header;
  }
  ExpectNone(InternalHeadersOutOfTheirFolder(AllIncludes()));
  EXPECT_EQ(InternalHeadersOutOfTheirFolder(IncludesOf("sim/rig.cpp", "render/rays/ray_terrain.h"))
                .size(),
            1u);
}

TEST(Includes, KeepActuationAndTractionFreeOfTheMultibody) {
  ExpectNone(WhatActuationMayNotSee(AllIncludes()));
  const auto faults = [](const std::string& header) {
    return WhatActuationMayNotSee(IncludesOf("physics/actuation/lever_map.cpp", header)).size();
  };
  EXPECT_EQ(faults("BulletDynamics/Featherstone/btMultiBody.h"), 1u);
  EXPECT_EQ(faults("physics/dynamics/joint_drive.h"), 1u);
  EXPECT_EQ(faults("core/random.h"), 0u);
}

TEST(Includes, KeepTheStatisticsFreeOfMachines) {
  ExpectNone(WhatStatisticsMayNotSee(AllIncludes()));
  const auto faults = [](const std::string& header) {
    return WhatStatisticsMayNotSee(IncludesOf("diagnose/statistics/series/series.h", header))
        .size();
  };
  EXPECT_EQ(faults("physics/description/machine.h"), 1u);
  EXPECT_EQ(faults("diagnose/replay/axis_log.h"), 1u);
  EXPECT_EQ(faults("core/random.h"), 0u);
}

}  // namespace
