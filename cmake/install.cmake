# SPDX-License-Identifier: MIT
# `cmake --install build/release --prefix DIR` leaves a tree that can be carried to another x86-64
# Linux machine: the program, its assets, and in lib/afterglow the libraries that it links. Of the
# machine it needs glibc and libstdc++ at least as new as here, since its OpenGL driver must find
# those that it was made for, and that driver (libEGL, or libOSMesa) itself.
include(GNUInstallDirs)

set(library_folder lib/afterglow) # not Debian's lib/x86_64-linux-gnu: the tree is its own
file(RELATIVE_PATH from_program /${CMAKE_INSTALL_BINDIR} /${library_folder})
set_target_properties(afterglow PROPERTIES INSTALL_RPATH "$ORIGIN/${from_program}")
# An RPATH: what the libraries link themselves is looked for there as well, unlike by a RUNPATH.
target_link_options(afterglow PRIVATE LINKER:--disable-new-dtags)

install(TARGETS afterglow RUNTIME_DEPENDENCY_SET linked RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(RUNTIME_DEPENDENCY_SET linked
    PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|gcc_s|stdc\\+\\+)\\.so"
    LIBRARY DESTINATION ${library_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/assets/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/afterglow/assets)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
