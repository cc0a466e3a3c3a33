# Writes HEADER with the commit of SOURCE, or none where it is not known: no git, or no repository of its own. Run at every
# build by `cmake -D SOURCE=... -D HEADER=... -D TEMPLATE=... -P`; what is as it was is not touched.
cmake_minimum_required(VERSION 3.25)

set(TERA_COMMIT "")
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --abbrev=12 "--exclude=*"
    OUTPUT_VARIABLE TERA_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  string(REGEX REPLACE "-dirty$" " and changes" TERA_COMMIT "${TERA_COMMIT}")
endif()
configure_file(${TEMPLATE} ${HEADER} @ONLY)
