# Writes app/about/version.h, for `tera --version`: how the program is built, which libraries the modules have found and
# which it does without. To include when all modules are there. A row is: name, folder that looks for it, variable with its version.
set(rows
  "assimp src/render assimp_VERSION"
  "Bullet src/physics BULLET_VERSION"
  "CLI11 src/app CLI11_VERSION"
  "cpp-httplib src/view HTTPLIB_VERSION"
  "EGL src/render EGL_VERSION"
  "Eigen . Eigen3_VERSION"
  "Embree src/render embree_VERSION"
  "fmt . fmt_VERSION"
  "GDAL src/soil GDAL_VERSION"
  "GeographicLib src/dataset GEOGRAPHICLIB_VERSION"
  "libepoxy src/render EPOXY_VERSION"
  "OpenCV src/dataset OpenCV_VERSION"
  "OpenSSL src/dataset OPENSSL_VERSION"
  "SQLite src/dataset SQLite3_VERSION"
  "yaml-cpp src/core yaml-cpp_VERSION")
set(absent)
# note(NAME TARGET FOLDER VARIABLE COMMAND): one that the program may do without.
function(note name target folder variable command)
  if(TARGET ${target})
    set(rows "${rows};${name} ${folder} ${variable}" PARENT_SCOPE)
  else()
    set(absent "${absent};${name} (${command})" PARENT_SCOPE)
  endif()
endfunction()
if(TERA_WHOLE_PROGRAM)
  list(APPEND rows "Ceres src/diagnose Ceres_VERSION" "pagmo src/layout pagmo_VERSION")
  note(CycloneDDS tera::ros2 src/ros2 CycloneDDS_VERSION "tera ros2")
  note(gRPC tera::serve src/serve GRPC_grpc++_VERSION "tera serve")
  note(PCL tera::survey src/survey PCL_VERSION "tera site and tera register")
else()
  set(absent "what the quickstart has no need of")
endif()
list(FILTER absent EXCLUDE REGEX "^$")
set(found)
foreach(row IN LISTS rows)
  string(REPLACE " " ";" row "${row}")
  list(POP_FRONT row name folder variable)
  get_directory_property(version DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DEFINITION ${variable})
  string(STRIP "${name} ${version}" named)
  list(APPEND found ${named})
endforeach()
list(JOIN found ", " TERA_LIBRARIES)
list(JOIN absent ", " TERA_ABSENT_LIBRARIES)
set(TERA_COMPILER "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
set(TERA_BUILD_TYPE "${CMAKE_BUILD_TYPE}")
configure_file(${PROJECT_SOURCE_DIR}/src/app/about/version.h.in ${PROJECT_BINARY_DIR}/src/app/app/about/version.h @ONLY)
