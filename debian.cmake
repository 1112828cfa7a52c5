# What Debian wants otherwise than `cmake --install` leaves it, in the folder that CPack makes a package of.
set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share)
file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
file(RENAME ${share}/doc/obscura/LICENSE ${share}/doc/obscura/copyright)
file(RENAME ${share}/doc/obscura/CHANGELOG.md ${share}/doc/obscura/changelog)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${share}/doc/obscura/changelog.Debian
"obscura (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * What is new is in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
file(GLOB pages ${share}/man/man1/*.1)
execute_process(COMMAND gzip -9n ${pages} ${share}/doc/obscura/changelog ${share}/doc/obscura/changelog.Debian
                COMMAND_ERROR_IS_FATAL ANY)
