// Pages in headless Chromium, which opens them from disk as a person would.
#pragma once

#include "cli/gloam_process.h"

namespace gloam::test {

/// How a page is opened.
struct Opening {
  int width =
      1280;  ///< of the page in pixels; it is in a frame, since a browser's window cannot be as narrow as a telephone
  std::string address;  ///< what follows the #
};

class BrowserTest : public Cli {
 protected:
  static bool has_browser() { return std::system("command -v chromium >/dev/null") == 0; }

  /// Opens a page, runs `begin` and `script` in it, and returns the value of `result`. The page must not complain.
  nlohmann::json in_browser(const fs::path& file, const std::string& begin, const std::string& script,
                            const Opening& opening = {}) const {
    std::string page = slurp(file);
    const size_t start = page.find("<script"), end = page.rfind("</body>");
    const std::string watch =
        "<script>const problems = []; addEventListener('error', (e) => problems.push(e.message));"
        "addEventListener('unhandledrejection', (e) => problems.push(String(e.reason)));"
        "addEventListener('securitypolicyviolation', (e) => problems.push('asked for ' + e.blockedURI));</script>\n";
    const std::string run =
        "<script>const wait = (ms) => new Promise((done) => setTimeout(done, ms));"
        "const until = async (holds) => { for (let i = 0; i < 8000 && !holds(); ++i) await wait(25);"
        " if (!holds()) problems.push('never came: ' + holds); };"
        "const click = (e, more) => e.dispatchEvent(new MouseEvent('click', {bubbles: true, ...more}));"
        "(async () => { const result = {}; try { " +
        begin + script +
        "} catch (e) { problems.push(String(e)); } result.problems = problems; parent.postMessage(result, '*'); })();"
        "</script>\n";
    page.insert(end, run).insert(start, watch);
    std::ofstream(path("watched.html")) << page;
    // While a document is still being written, the browser does not end before the page has answered.
    std::ofstream(path("frame.html")) << "<!DOCTYPE html><iframe id='open'></iframe><script>const open = "
                                         "document.getElementById('open').contentDocument; open.open();"
                                         "addEventListener('message', (e) => { document.body.append('RESULT' + "
                                         "encodeURIComponent(JSON.stringify(e.data)) + 'END'); open.close(); });"
                                         "</script><iframe src='watched.html" +
                                             (opening.address.empty() ? "" : "#" + opening.address) +
                                             "' style='border:0;height:900px;width:" + std::to_string(opening.width) +
                                             "px'></iframe>";
    const std::string command =
        "timeout 400 chromium --headless --no-sandbox --disable-gpu --window-size=1400,1000 "
        "--enable-logging=stderr --v=0 --dump-dom --user-data-dir='" +
        path("profile").string() + "' 'file://" + path("frame.html").string() + "' >'" + path("dom").string() +
        "' 2>'" + path("log").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << lines_with(slurp(path("log")), "CONSOLE");
    EXPECT_EQ(lines_with(slurp(path("log")), "CONSOLE"), "");
    const nlohmann::json result = answer_in(slurp(path("dom")));
    EXPECT_EQ(result.value("problems", nlohmann::json()), nlohmann::json::array());
    return result;
  }

  static std::string lines_with(const std::string& text, const std::string& word) {
    std::istringstream stream(text);
    std::string found;
    for (std::string line; std::getline(stream, line);) {
      if (line.find(word) != std::string::npos) found += line + "\n";
    }
    return found;
  }

 private:
  static nlohmann::json answer_in(const std::string& dom) {
    const size_t from = dom.find("RESULT%"), to = dom.find("END", from);
    if (from == std::string::npos) {
      ADD_FAILURE() << "the page said nothing";
      return nlohmann::json::object();
    }
    std::string text;
    for (size_t i = from + 6; i < to; ++i) {
      if (dom[i] != '%') {
        text += dom[i];
        continue;
      }
      text += char(std::stoi(dom.substr(i + 1, 2), nullptr, 16));
      i += 2;
    }
    return nlohmann::json::parse(text);
  }
};

}  // namespace gloam::test
