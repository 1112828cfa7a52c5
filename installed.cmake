# What an installation holds. Programs find what they read beside themselves, in ../share/obscura (base/shipped.h);
# the build folder has the same tree, with links to the sources, so that they find it there too.
include(GNUInstallDirs)

# Every program: an executable whose main() is in a main.cpp.
function(obscura_programs_in folder list)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    get_target_property(sources ${target} SOURCES)
    if(type STREQUAL "EXECUTABLE" AND "main.cpp" IN_LIST sources)
      list(APPEND ${list} ${target})
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(each ${folders})
    obscura_programs_in(${each} ${list})
  endforeach()
  set(${list} ${${list}} PARENT_SCOPE)
endfunction()
set(obscura_programs "")
obscura_programs_in(${PROJECT_SOURCE_DIR} obscura_programs)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # nor tests, when packaging
install(TARGETS ${obscura_programs} DESTINATION ${CMAKE_INSTALL_BINDIR})

# What they read.
set(share ${PROJECT_BINARY_DIR}/share)
set(shipped ${CMAKE_INSTALL_DATADIR}/obscura)
file(MAKE_DIRECTORY ${share}/obscura/programs)
foreach(item renderer/shaders protocols docs/techniques.in.md)
  get_filename_component(name ${item} NAME)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${item} ${share}/obscura/${name} SYMBOLIC)
endforeach()
install(DIRECTORY renderer/shaders DESTINATION ${shipped})
install(DIRECTORY protocols DESTINATION ${shipped} FILES_MATCHING PATTERN "*.toml" PATTERN reader EXCLUDE)
install(FILES docs/techniques.in.md DESTINATION ${shipped})

# What they say of themselves: manual pages, and the tables that completion and `obscura` go by, whose own, as it
# lists the others, is the last.
set(descriptions "")
foreach(program ${obscura_programs})
  set(of_${program} ${share}/man/man1/${program}.1 ${share}/obscura/programs/${program}.csv)
  list(APPEND descriptions ${of_${program}})
endforeach()
foreach(program ${obscura_programs})
  set(others "")
  if(program STREQUAL "obscura")
    set(others ${descriptions})
    list(REMOVE_ITEM others ${of_obscura})
  endif()
  add_custom_command(OUTPUT ${of_${program}} DEPENDS ${program} ${others} VERBATIM
    COMMENT "Describing ${program}" COMMAND ${program} --describe-into ${share})
endforeach()
add_custom_target(descriptions ALL DEPENDS ${descriptions})
install(DIRECTORY ${share}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR})
install(DIRECTORY ${share}/obscura/programs DESTINATION ${shipped})

# Completion. Bash looks for a file of the program's name, zsh for one that names its programs.
list(JOIN obscura_programs " " programs)
configure_file(entry/obscura.bash.in ${share}/bash-completion/completions/obscura @ONLY)
configure_file(entry/_obscura.in ${share}/zsh/site-functions/_obscura @ONLY)
foreach(program ${obscura_programs})
  if(NOT program STREQUAL "obscura")
    file(CREATE_LINK obscura ${share}/bash-completion/completions/${program} SYMBOLIC)
  endif()
endforeach()
install(DIRECTORY ${share}/bash-completion ${share}/zsh DESTINATION ${CMAKE_INSTALL_DATADIR})

# What people read. README.md names files as they lie beside it.
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN techniques.in.md EXCLUDE)
install(FILES analysis/thesis_table4.csv DESTINATION ${CMAKE_INSTALL_DOCDIR}/analysis)
install(PROGRAMS scripts/cluster/parallel.sh scripts/cluster/slurm.sh DESTINATION ${CMAKE_INSTALL_DOCDIR}/scripts/cluster)

# A Debian package: cpack -G DEB, or scripts/package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME obscura)
set(CPACK_PACKAGE_CONTACT "The Obscura authors <obscura@localhost>") # who gives it to others says cpack -D CPACK_PACKAGE_CONTACT=...
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/debian.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Besides what programs are linked to: OpenGL is looked for at run time, and the viewer reads this font's files.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libgl1, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libgl1-mesa-dri, gnuplot-nox, fonts-wqy-microhei")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Obscura asks people. It renders pairs of images that differ in the technique of
ambient occlusion and in nothing else, shows them to participants one after the
other, and turns their answers into statistics. It also measures techniques:
how fast, how right and how steady they are, beside a ray-traced reference.")
include(CPack)
