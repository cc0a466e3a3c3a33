# `cpack` in a build folder makes Debian packages: tera-sim, the program with its data, manual pages and completions;
# tera-sim-dev, the libraries with their headers; and tera-prove, where its libraries are there. Which libraries they need is
# found by dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tera-sim)
set(CPACK_PACKAGE_CONTACT "TERA maintainers <maintainers@localhost.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME tera-sim)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# What libepoxy opens at run time, Mesa's drivers, which draw where there is no GPU, and the programs of `tera overview`.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libegl1, libegl-mesa0, libgl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "ffmpeg, gdal-bin, gnuplot-nox")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS
  "python3-numpy, python3-opencv, python3-yaml, python3-grpcio, python3-protobuf, tera-sim-dev")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "An excavator at work on soil is simulated and measured with the cameras,
lidars, inertial units, GNSS receivers and encoders of a real machine,
without a display. Makes labelled datasets, says why a recording of a real
machine differs from its simulation, and where sensors should go.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME tera-sim-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# Whoever links static libraries needs what they are linked with; some serve the program's commands alone.
file(STRINGS scripts/packages.txt libraries REGEX "^libraries: ")
string(REGEX REPLACE "^libraries: " "" libraries "${libraries}")
string(REPLACE " " ";" libraries "${libraries}")
list(REMOVE_ITEM libraries libboost-math-dev libceres-dev libcli11-dev libcpp-httplib-dev libpagmo-dev)
list(JOIN libraries ", " libraries)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "tera-sim (= ${PROJECT_VERSION}), ${libraries}")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Static libraries of TERA with their headers, and a package file for CMake's
find_package(tera).")

if(TARGET tera-prove)
  list(APPEND CPACK_COMPONENTS_ALL prove)
endif()
set(CPACK_DEBIAN_PROVE_PACKAGE_NAME tera-prove)
set(CPACK_DEBIAN_PROVE_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROVE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROVE_PACKAGE_DEPENDS "tera-sim (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_PROVE_DESCRIPTION
  "Conceals effects in recordings of two simulators that share nothing with TERA,
has its diagnosis answer, and marks the answers.")

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} COMPONENT)
  install(FILES cmake/copyright COMPONENT ${component}
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
endforeach()
include(CPack)
