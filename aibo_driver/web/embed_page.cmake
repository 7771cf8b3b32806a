# Writes page.html as a function in C++.
file(READ ${HTML} page)
file(WRITE ${OUTPUT} "#include \"web/page_server.h\"\n\nnamespace aibo_driver::web {\n\nstd::string pageHtml() {\n"
  "  return R\"page(${page})page\";\n}\n\n}  // namespace aibo_driver::web\n")
