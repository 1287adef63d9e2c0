# What `cmake --install` puts where. The program finds its data beside itself
# (../share/palpa/assets), so the tree may be moved; the Debian package is this tree below /usr.
include(GNUInstallDirs)
set(made ${PROJECT_BINARY_DIR}/package)

set(PALPA_MAINTAINER "Palpa <palpa@localhost.localdomain>" CACHE STRING
  "Who answers for the package that is built here: name and address")

# Manual page and completion come out of the program itself: they cannot be older than its options.
find_program(GZIP_PROGRAM gzip REQUIRED)
string(TIMESTAMP packed "%a, %d %b %Y 00:00:00 +0000" UTC)  # of SOURCE_DATE_EPOCH where it is set
configure_file(cmake/package/changelog.in ${made}/changelog @ONLY)
add_custom_command(OUTPUT ${made}/palpa.1.gz ${made}/palpa.bash ${made}/changelog.gz
  ${made}/CHANGELOG.md.gz
  COMMAND ${CMAKE_COMMAND} -E make_directory ${made}
  COMMAND palpa manual | ${GZIP_PROGRAM} -9n > ${made}/palpa.1.gz
  COMMAND palpa manual --completion > ${made}/palpa.bash
  COMMAND ${GZIP_PROGRAM} -9nc ${made}/changelog > ${made}/changelog.gz
  COMMAND ${GZIP_PROGRAM} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md > ${made}/CHANGELOG.md.gz
  DEPENDS palpa ${made}/changelog ${PROJECT_SOURCE_DIR}/CHANGELOG.md VERBATIM)
add_custom_target(palpa_manual ALL
  DEPENDS ${made}/palpa.1.gz ${made}/palpa.bash ${made}/changelog.gz ${made}/CHANGELOG.md.gz)

install(TARGETS palpa RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS palpa_opencv_codecs LIBRARY DESTINATION ${PALPA_LOADED_INSTALLED})
install(DIRECTORY assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/palpa/assets
  PATTERN pictures EXCLUDE
  PATTERN "*.sh" EXCLUDE)
install(DIRECTORY assets/udev/ DESTINATION lib/udev/rules.d FILES_MATCHING PATTERN "*.rules")
install(FILES cmake/package/palpa.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES cmake/package/palpa.svg
  DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${made}/palpa.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${made}/palpa.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME palpa)
install(FILES cmake/package/copyright ${made}/changelog.gz ${made}/CHANGELOG.md.gz
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/palpa)
