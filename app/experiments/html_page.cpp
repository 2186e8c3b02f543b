#include "app/experiments/html_page.h"

#include "app/experiments/svg_scatter.h"

namespace bounce {

std::string html_page(const std::string& title, const std::string& style, const std::string& body) {
    return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
           // Pictures and style of its own, and no script at all: what a name holds can only ever be shown.
           "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
           "'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
           "<title>Bounce: " +
           escape_markup(title) +
           "</title>\n<style>\n"
           "body{font:14px/1.5 sans-serif;margin:2em auto;max-width:1400px;padding:0 1em;color:#222}\n"
           "table{border-collapse:collapse;width:100%}td,th{padding:.3em .6em;border-bottom:1px solid "
           "#ddd;text-align:right;vertical-align:top}\n"
           "td:first-child,th:first-child{text-align:left}code{font-size:12px;background:#f4f4f4;padding:.1em .3em}\n" +
           style + "</style></head><body>\n" + body + "</body></html>\n";
}

} // namespace bounce
