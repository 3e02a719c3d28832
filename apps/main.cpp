#include "apps/program.h"

int main(int argc, char** argv) {
  return tetraglass::apps::run(argc, argv);
}
