# From the names in ${commands}: ${command_sources}, their files and one that is made here, in which
# add_commands() (commands/commands.h) calls add_NAME() of each.
set(command_sources ${PROJECT_BINARY_DIR}/generated/add_commands.cpp)
set(declarations "")
set(calls "")
foreach(command IN LISTS commands)
  list(APPEND command_sources commands/${command}.cpp)
  string(APPEND declarations "void add_${command}(Program& program);\n")
  string(APPEND calls "  add_${command}(program);\n")
endforeach()
file(
  CONFIGURE
  OUTPUT ${PROJECT_BINARY_DIR}/generated/add_commands.cpp
  CONTENT "// Made from the list in tools/CMakeLists.txt.
#include \"morsel/tools/commands/commands.h\"

namespace morsel::tools {

${declarations}
void add_commands(Program& program) {
${calls}}

}  // namespace morsel::tools
")
