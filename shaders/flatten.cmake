# Writes a shader as one text for OpenGL's own compiler, as a C++ string:
#   cmake -DGLSLANG=... -DSOURCE=in.comp -DHEADER=out.h -DNAME=variable -P flatten.cmake
get_filename_component(folder ${SOURCE} DIRECTORY)
execute_process(COMMAND ${GLSLANG} -E -DTRISECT_OPENGL -I${folder} ${SOURCE}
                OUTPUT_VARIABLE text RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${SOURCE} was not preprocessed")
endif()
# app/opengl/shader_head.cpp gives the version, with the values of the constants. What other directives the preprocessor
# leaves, such as #extension for Vulkan, are dropped.
string(REGEX REPLACE "#[^\n]*\n" "" text "${text}")
# NVIDIA's compiler takes no element of a buffer with readonly or restrict as the argument of a function whose parameter
# has no such qualifier (error C1317); they only allow optimisations.
string(REGEX REPLACE "((readonly|writeonly|restrict) )+buffer " "buffer " text "${text}")
string(REGEX REPLACE "\n\n+" "\n" text "${text}")
file(WRITE ${HEADER} "constexpr const char* ${NAME} = R\"glsl(${text})glsl\";\n")
