# What `cmake --install` puts where. The program finds its data beside itself
# (../share/palpa/assets), so the tree may be moved; the Debian package is this tree below /usr.
include(GNUInstallDirs)
set(made ${PROJECT_BINARY_DIR}/package)

# Manual page and completion come out of the program itself: they cannot be older than its options.
find_program(GZIP_PROGRAM gzip REQUIRED)
add_custom_command(OUTPUT ${made}/palpa.1.gz ${made}/palpa.bash ${made}/changelog.gz
  COMMAND ${CMAKE_COMMAND} -E make_directory ${made}
  COMMAND palpa manual | ${GZIP_PROGRAM} -9n > ${made}/palpa.1.gz
  COMMAND palpa manual --completion > ${made}/palpa.bash
  COMMAND ${GZIP_PROGRAM} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md > ${made}/changelog.gz
  DEPENDS palpa ${PROJECT_SOURCE_DIR}/CHANGELOG.md VERBATIM)
add_custom_target(palpa_manual ALL
  DEPENDS ${made}/palpa.1.gz ${made}/palpa.bash ${made}/changelog.gz)

install(TARGETS palpa RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS palpa_opencv_codecs LIBRARY DESTINATION ${PALPA_LOADED_INSTALLED})
install(DIRECTORY assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/palpa/assets
  PATTERN pictures EXCLUDE
  PATTERN "*.sh" EXCLUDE)
install(FILES assets/udev/60-palpa-falcon.rules DESTINATION lib/udev/rules.d)
install(FILES cmake/package/palpa.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES cmake/package/palpa.svg
  DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${made}/palpa.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${made}/palpa.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME palpa)
install(FILES cmake/package/copyright ${made}/changelog.gz
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/palpa)
