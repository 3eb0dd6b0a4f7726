# Installs what the package trisect holds into a folder of its own, and looks at what is there, and at what a Debian
# package is told to depend on.
#   cmake -DBUILD=... -DFOLDER=... -P run.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../support/run.cmake)

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER} --component program --strip)

set(expected bin/trisect
  share/bash-completion/completions/trisect share/zsh/vendor-completions/_trisect
  share/fish/vendor_completions.d/trisect.fish
  share/trisect/assets/teapot.obj share/trisect/shaders/shared.h share/trisect/shaders/trace_list.comp
  share/doc/trisect/copyright share/doc/trisect/changelog.gz share/doc/trisect/notices.gz
  share/doc/trisect/README.md share/doc/trisect/docs/surfaces.md)
# A page of the manual for the program and for each of its commands, which --help lists by two spaces and a name.
set(pages "trisect")
run(${FOLDER}/bin/trisect --help)
string(REGEX REPLACE ".*\nCommands:\n(.*)\n\nHelp:.*" "\\1" commands "${output}")
string(REGEX MATCHALL "(^|\n)  [a-z]+" commands "${commands}")
foreach(command ${commands})
  string(STRIP "${command}" command)
  list(APPEND pages trisect-${command})
endforeach()
list(LENGTH pages count)
if(count LESS 11)
  message(FATAL_ERROR "--help lists these commands only: ${pages}")
endif()
foreach(page ${pages})
  list(APPEND expected share/man/man1/${page}.1.gz)
endforeach()
foreach(file ${expected})
  if(NOT EXISTS ${FOLDER}/${file})
    message(FATAL_ERROR "the package lacks ${file}")
  endif()
endforeach()
run(gzip -t ${FOLDER}/share/man/man1/trisect.1.gz ${FOLDER}/share/doc/trisect/changelog.gz)

# Nothing of the library's package, of the tests or of the build tree.
file(GLOB_RECURSE installed RELATIVE ${FOLDER} ${FOLDER}/*)
foreach(file ${installed})
  if(NOT file MATCHES "^(bin/trisect$|share/(bash-completion|zsh|fish|man|doc/trisect|trisect)/)")
    message(FATAL_ERROR "the package should not have ${file}")
  endif()
endforeach()

file(READ ${BUILD}/CPackConfig.cmake settings)
foreach(setting "PROGRAM_PACKAGE_SHLIBDEPS \"ON\"" "PROGRAM_PACKAGE_DEPENDS \"mesa-vulkan-drivers | vulkan-icd\""
    "PROGRAM_PACKAGE_SECTION \"graphics\"")
  string(FIND "${settings}" "CPACK_DEBIAN_${setting}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "CPack is not told CPACK_DEBIAN_${setting}")
  endif()
endforeach()
