// atrium-pdf-draw: draws SVG sheets as PDF, in a process of its own. glib ends a program where memory or threads lack;
// here that is this one, and the node says so. Request on the standard input, reply on the standard output; what
// libraries print goes to the standard error.
#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "graph/api/error.hpp"
#include "graph/api/standard_streams.hpp"
#include "modules/pdf/drawing.hpp"
#include "modules/pdf/pdf_pages.hpp"

namespace {

std::string read_all(int file) {
  std::string bytes;
  char buffer[1 << 16];
  for (ssize_t size = 0; (size = ::read(file, buffer, sizeof buffer)) != 0;) {
    if (size < 0) throw std::runtime_error("the request cannot be read");
    bytes.append(buffer, static_cast<std::size_t>(size));
  }
  return bytes;
}

bool write_all(int file, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t size = ::write(file, bytes.data() + done, bytes.size() - done);
    if (size <= 0) return false;
    done += static_cast<std::size_t>(size);
  }
  return true;
}

atrium::pdf::DrawingReply drawn(const atrium::pdf::DrawingRequest& request) {
  atrium::pdf::DrawingReply reply;
  try {
    reply.lacking = atrium::pdf::texts_without_font(request.texts);
    atrium::pdf::PdfPages pages(request.title);
    for (const auto& page : request.pages) pages.add(page.svg, {page.width, page.height});
    reply.file = std::move(pages).finish();
  } catch (const atrium::Error& error) {
    reply.problem = error.what();
    reply.help = error.help();
  }
  return reply;
}

}  // namespace

int main() {
  atrium::secure_standard_streams();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing is left of a run that is killed
  const int replies = ::dup(STDOUT_FILENO);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  try {
    const auto reply = to_bytes(drawn(atrium::pdf::request_from(read_all(STDIN_FILENO))));
    if (write_all(replies, reply)) return 0;
    std::fputs("the reply cannot be written\n", stderr);
    return 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
