# Writes the commit of a source tree, and whether it was changed since, as a C++ header if that is news:
# cmake -DGIT=git -DSOURCE=tree -DHEADER=out.h -P commit.cmake
cmake_minimum_required(VERSION 3.25)
set(commit "")
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --abbrev=10 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(commit STREQUAL "")
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define TRISECT_COMMIT \"@commit@\"\n" @ONLY)
