# Installs BUILD into SCRATCH, moves the installation, and uses it there: the program by itself, the
# libraries in a project of their own. Run by `cmake -D... -P`.
cmake_minimum_required(VERSION 3.25)

set(first ${SCRATCH}/first)
set(moved ${SCRATCH}/moved)
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH}/elsewhere)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${SCRATCH}/elsewhere OUTPUT_VARIABLE output
    ERROR_VARIABLE output RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(need text)
  string(FIND "${output}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "'${text}' is not in\n${output}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${first})
file(RENAME ${first} ${moved})

# The program finds its data beside itself, wherever both were moved.
run(${moved}/bin/tera info)
need("${moved}/share/tera")
run(${moved}/bin/tera check ${moved}/share/tera/config/scenarios/quickstart.yaml)
need("valid")
file(WRITE ${SCRATCH}/elsewhere/small.yaml "name: small
duration_s: 0.1
settle_s: 0.1
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
machines:
  - name: rover1
    machine: tera:config/machines/warthog.yaml
    operator: {type: idle}
    rig: {sensors: [{name: camera, preset: tera:config/sensors/rgb_640.yaml, link: chassis}]}
")
run(${moved}/bin/tera generate small.yaml --out run)
if(NOT EXISTS ${SCRATCH}/elsewhere/run/rover1/camera/rgb/0.png)
  message(FATAL_ERROR "the installed program drew no picture")
endif()

if(EXISTS ${BUILD}/tera-prove)
  run(${moved}/bin/tera-prove --version)
  need("tera-prove ")
endif()

# What is said of the program by itself came along.
foreach(file share/man/man1/tera.1.gz share/man/man1/tera-layout-evaluate.1.gz share/bash-completion/completions/tera
    share/zsh/vendor-completions/_tera share/fish/vendor_completions.d/tera.fish share/doc/tera-sim/copyright)
  file(SIZE ${moved}/${file} size)
  if(size LESS 200)
    message(FATAL_ERROR "${moved}/${file} has ${size} bytes")
  endif()
endforeach()

# find_package(tera), link, run.
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${SCRATCH}/consumer -G ${GENERATOR}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${moved})
run(${CMAKE_COMMAND} --build ${SCRATCH}/consumer)
run(${SCRATCH}/consumer/consumer)
file(REMOVE_RECURSE ${SCRATCH})
