#include "apps/learning/web_text.h"

#include <algorithm>

#include "anatomy/base/error.h"

namespace palpa::learning {
namespace {

std::string escaped(const std::string& text) {
  constexpr std::string_view kPlain = "-._~";
  std::string out;
  for (const unsigned char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       kPlain.find(static_cast<char>(c)) != std::string_view::npos;
    if (plain) {
      out += static_cast<char>(c);
      continue;
    }
    out += '%';
    out += "0123456789ABCDEF"[c >> 4];
    out += "0123456789ABCDEF"[c & 15];
  }
  return out;
}

std::string inHtml(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

}  // namespace

std::string queryOf(const Fields& fields) {
  std::string query;
  for (const auto& [name, value] : fields)
    query += (query.empty() ? "" : "&") + escaped(name) + "=" + escaped(value);
  return query;
}

std::string withQuery(const std::string& url, const Fields& fields) {
  return url + (url.find('?') == std::string::npos ? "?" : "&") + queryOf(fields);
}

std::string fieldIn(const Fields& fields, const std::string& name) {
  const auto named = [&](const auto& field) { return field.first == name; };
  const auto found = std::find_if(fields.begin(), fields.end(), named);
  if (found == fields.end()) return "";
  if (std::count_if(fields.begin(), fields.end(), named) > 1)
    throw UsageError("comes twice", "\"" + name + "\" of the launch",
                     "Start again from the course");
  return found->second;
}

std::string neededIn(const Fields& fields, const std::string& name, std::size_t most) {
  std::string value = fieldIn(fields, name);
  if (value.empty() || value.size() > most)
    throw UsageError(value.empty() ? "is missing" : "is too long", "\"" + name + "\" of the launch",
                     "Start again from the course");
  return value;
}

std::string pageOfWords(const std::string& title, const std::string& words,
                        const std::string& back) {
  constexpr std::string_view kHead =
      "</title><meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<link rel=\"icon\" href=\"/static/palpa.svg\" type=\"image/svg+xml\">"
      "<link rel=\"stylesheet\" href=\"/static/style.css\"></head>"
      "<body><main><div class=\"card narrow\"><h1 class=\"page-head\">";
  const std::string link = back.empty() ? ""
                                        : "<p><a class=\"button\" href=\"" + inHtml(back) +
                                              "\">Back to the course</a></p>";
  std::string page = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>";
  page.append(inHtml(title)).append(kHead).append(inHtml(title)).append("</h1><p class=\"lead\">");
  return page.append(inHtml(words)).append("</p>").append(link) + "</div></main></body></html>\n";
}

}  // namespace palpa::learning
