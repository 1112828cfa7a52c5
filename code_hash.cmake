# obscura_code_hash(TARGET NAME FILES...): gives TARGET a function `std::string_view NAME()` whose value
# is the SHA-256 of those sources and of what compiles them, found anew whenever one of them changes,
# committed or not. What was made by other code can then be told from what was made by this.
# Lines that are only a comment do not count.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(OBSCURA_CODE_HASH ${CMAKE_CURRENT_LIST_FILE})
  function(obscura_code_hash target name)
    string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
    set(compiler "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_SYSTEM_PROCESSOR} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${OBSCURA_SANITIZE} OpenImageIO ${OpenImageIO_VERSION} Embree ${embree_VERSION}")
    set(list ${PROJECT_BINARY_DIR}/${name}.files)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    list(SORT ARGN)
    list(REMOVE_DUPLICATES ARGN)
    string(REPLACE ";" "\n" lines "${ARGN}")
    file(GENERATE OUTPUT ${list} CONTENT "${lines}\n")
    add_custom_command(OUTPUT ${output} DEPENDS ${ARGN} ${list} ${OBSCURA_CODE_HASH} VERBATIM
      COMMENT "Hashing the sources of ${name}()"
      COMMAND ${CMAKE_COMMAND} "-Droot=${PROJECT_SOURCE_DIR}" "-Dlist=${list}" "-Dname=${name}"
              "-Dcompiler=${compiler}" "-Doutput=${output}" -P ${OBSCURA_CODE_HASH})
    target_sources(${target} PRIVATE ${output})
  endfunction()
  return()
endif()

file(STRINGS ${list} files)
set(all "${compiler}\n")
foreach(file ${files})
  file(READ ${file} content)
  string(REGEX REPLACE "\n[ \t]*//[^\n]*" "" content "\n${content}")
  file(RELATIVE_PATH path ${root} ${file})
  string(SHA256 hash "${content}")
  string(APPEND all "${hash} ${path}\n")
endforeach()
string(SHA256 hash "${all}")
file(WRITE ${output} "#include <string_view>\n\nnamespace obscura {\nstd::string_view ${name}();\nstd::string_view ${name}() { return \"${hash}\"; }\n} // namespace obscura\n")
