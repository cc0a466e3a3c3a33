# What most sources include is precompiled twice: for modules that compute, and for those that read and write. g++ optimises
# as the precompiled headers were compiled, whatever a source asks for.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/module_headers.cpp CONTENT "")
foreach(headers tera_module_headers tera_light_headers)
  add_library(${headers} OBJECT ${PROJECT_BINARY_DIR}/module_headers.cpp)
  target_link_libraries(${headers} PRIVATE tera_options)
  target_precompile_headers(${headers} PRIVATE <Eigen/Geometry> <algorithm> <filesystem> <fmt/format.h> <functional> <map>
    <memory> <optional> <string> <variant> <vector>)
endforeach()
target_compile_options(tera_light_headers PRIVATE $<$<CONFIG:Release>:-O1>)

# tera_unite(TARGET FEW): with CMAKE_UNITY_BUILD the sources of one folder compile as one, at most twelve at a time, since most
# time goes into the headers that neighbours share. A folder of at most FEW sources joins its neighbours. Names in anonymous
# namespaces are therefore unique within a folder and its neighbours: a second function of a name would be an overload.
function(tera_unite TARGET FEW)
  if(CMAKE_UNITY_BUILD)
    # g++ takes an included source for a header, whose types must not rest on anonymous namespaces.
    target_compile_options(${TARGET} PRIVATE -Wno-subobject-linkage)
  endif()
  set_target_properties(${TARGET} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${TARGET} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  set(folders "")
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "room_${folder}" folder)
    list(APPEND folders ${folder})
    list(APPEND ${folder} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  set(most 12)
  set(size ${most})
  foreach(folder IN LISTS folders)
    list(LENGTH ${folder} count)
    if(count GREATER FEW AND size GREATER FEW)
      set(size ${most})
    endif()
    set(part 0)
    foreach(source IN LISTS ${folder})
      if(size EQUAL most)
        set(group ${folder}_${part})
        set(size 0)
        math(EXPR part "${part} + 1")
      endif()
      math(EXPR size "${size} + 1")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endforeach()
  endforeach()
endfunction()

# tera_module(NAME [PROGRAM_ONLY] [LIGHT] SOURCES ... PUBLIC ... PRIVATE ...): the static library tera_NAME of
# one folder of src/, with what it links. PUBLIC are other modules; third-party libraries are PRIVATE
# so that their headers stay inside the folder. A module that only the program uses is not installed. A LIGHT module waits for
# disks, networks and libraries: it is optimised little, which takes a third off its compilation.
function(tera_module NAME)
  cmake_parse_arguments(ARG "PROGRAM_ONLY;LIGHT" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(tera_${NAME} STATIC ${ARG_SOURCES})
  add_library(tera::${NAME} ALIAS tera_${NAME})
  set_target_properties(tera_${NAME} PROPERTIES EXPORT_NAME ${NAME})
  target_link_libraries(tera_${NAME} PUBLIC tera_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  if(ARG_LIGHT)
    target_compile_options(tera_${NAME} PRIVATE $<$<CONFIG:Release>:-O1>)
    target_precompile_headers(tera_${NAME} REUSE_FROM tera_light_headers)
  else()
    target_precompile_headers(tera_${NAME} REUSE_FROM tera_module_headers)
  endif()
  tera_unite(tera_${NAME} 5)
  if(NOT ARG_PROGRAM_ONLY)
    install(TARGETS tera_${NAME} EXPORT teraTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
      COMPONENT development)
  endif()
endfunction()

# tera_test(NAME LABELS ... [SLOW ...] SOURCES ... LINK ...): a test program; each TEST in it becomes a ctest
# test with its label, which says what a run costs and needs (test/CMakeLists.txt). SLOW are those of
# its tests, as GoogleTest's filters name them, that are labelled slow instead.
function(tera_test NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS;SLOW" ${ARGN})
  add_executable(${NAME} ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE ${ARG_LINK} GTest::gmock GTest::gtest_main)
  target_include_directories(${NAME} PRIVATE ${CMAKE_SOURCE_DIR}/test)
  target_precompile_headers(${NAME} REUSE_FROM ${TERA_TEST_HEADERS})
  tera_unite(${NAME} 0)
  if(ARG_SLOW)
    list(JOIN ARG_SLOW ":" slow)
    tera_discover_tests(${NAME} "-${slow}" "${ARG_LABELS}")
    tera_discover_tests(${NAME} "${slow}" slow)
  else()
    tera_discover_tests(${NAME} "*" "${ARG_LABELS}")
  endif()
  if(unit IN_LIST ARG_LABELS)
    add_dependencies(unit_tests ${NAME})
  endif()
endfunction()

function(tera_discover_tests NAME FILTER LABEL)
  gtest_discover_tests(${NAME} DISCOVERY_MODE PRE_TEST TEST_FILTER "${FILTER}"
    PROPERTIES LABELS "${LABEL}" TIMEOUT 600
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
endfunction()
