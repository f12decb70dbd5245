#pragma once
// What pages for browsers share: head and style, escaped text, links, and plots as pictures in the page. A page is one
// file without a request to anywhere. It is XML besides HTML, so that any parser can check it.

#include "export/plot.h"
#include "std.h"

namespace carom {

/// Text between tags or in quotes. Invisible characters and bytes that are not UTF-8 are escaped visibly.
string html_text(string_view text);

/// `<a href="path">text</a>` for the path of a file relative to the page.
string html_link(string_view path, string_view text);
/// The path as the value of `href` or `src`.
string html_address(string_view path);

/// "12 collisions"; "-0.1235": a number with at most five digits. Empty: it is not finite.
string short_number(double number);

/// From the document type into the body, with the title in the head alone. `style`: rules beside those of all pages.
string page_head(string_view title, string_view style = {});
string page_end();

/// The plots of a page. Titles and legends are text of the page.
struct PageFigures {
  /// The marks of all plots, to stand before the first figure.
  string marks;
  vector<string> figures;  // `<figure>`s, by plot
};
/// Throws ExportError.
PageFigures draw_figures(vector<Plot> plots, const string& gnuplot);

}  // namespace carom
