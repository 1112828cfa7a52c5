#include "report/html.h"

#include <fmt/format.h>
#include <openssl/evp.h>

namespace obscura {

namespace {

constexpr std::string_view head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width"/>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'{}"/>
<title>{}</title>
<style>
body {{ font: 16px/1.5 system-ui, sans-serif; color: #1a1a1a; background: white; max-width: 66rem;
       margin: 2rem auto; padding: 0 1rem; }}
h1 {{ font-size: 1.7rem; line-height: 1.25; margin-bottom: 0; }}
h2 {{ font-size: 1.2rem; margin-top: 2.2rem; border-bottom: 1px solid #ccc; }}
.aside {{ color: #555; font-size: .88rem; }}
figure {{ margin: 1rem 0; }}
.wide {{ overflow-x: auto; }}
table {{ border-collapse: collapse; font-size: .88rem; }}
th, td {{ padding: .25rem .5rem; text-align: left; vertical-align: top; }}
thead th {{ border-bottom: 2px solid #555; }}
tbody th {{ font-weight: 600; white-space: nowrap; }}
tbody tr {{ border-bottom: 1px solid #ddd; }}
.number {{ text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }}
@media print {{
  body {{ font-size: 10pt; margin: 0; max-width: none; }}
  .wide {{ overflow: visible; }}
  table, .aside {{ font-size: 7.5pt; }}
  th, td {{ padding: 2pt 3.5pt; }}
  figure, tr {{ break-inside: avoid; }}
  h2 {{ break-after: avoid; }}
}}
{}</style>
</head>
<body>
)";

} // namespace

std::string element(std::string_view name, std::string_view text) {
    return fmt::format("<{0}>{1}</{0}>\n", name, escaped(text));
}

std::string pageHead(std::string_view title, std::string_view style, bool scripted) {
    return fmt::format(head, scripted ? "; script-src 'unsafe-inline'" : "", escaped(title), style);
}

std::string dataAddress(std::string_view mediaType, std::string_view bytes) {
    std::string base64(4 * ((bytes.size() + 2) / 3) + 1, '\0'); // and a terminator
    EVP_EncodeBlock(reinterpret_cast<unsigned char*>(base64.data()),
                    reinterpret_cast<const unsigned char*>(bytes.data()),
                    static_cast<int>(bytes.size()));
    base64.pop_back();
    return "data:" + std::string(mediaType) + ";base64," + base64;
}

} // namespace obscura
