#!/usr/bin/python3
"""Prints an .xlsx file as JSON, read by openpyxl, an independent reader. A second argument, brief: without its cells."""
import json
import sys

import openpyxl


def text_of(title):
    """The text of a chart's or an axis' title."""
    if title is None or title.tx is None or title.tx.rich is None:
        return None
    return "".join(run.t for paragraph in title.tx.rich.p for run in (paragraph.r or []))


def chart_of(chart):
    return {
        "kind": type(chart).__name__,
        "title": text_of(chart.title),
        "x": text_of(chart.x_axis.title),
        "y": text_of(chart.y_axis.title),
        "row": chart.anchor._from.row,
        "column": chart.anchor._from.col,
        "last_row": chart.anchor.to.row,
        "last_column": chart.anchor.to.col,
        "series": [
            {
                "name": series.tx.v if series.tx else None,
                "x": (series.xVal or series.cat).numRef.f if (series.xVal or series.cat).numRef else None,
                "y": (series.yVal or series.val).numRef.f,
                "bar": series.errBars.val if series.errBars else None,  # its length
            }
            for series in chart.series
        ],
    }


brief = sys.argv[2:] == ["brief"]
book = openpyxl.load_workbook(sys.argv[1])
values = book if brief else openpyxl.load_workbook(sys.argv[1], data_only=True)
sheets = {}
for sheet in book:
    if brief:
        sheets[sheet.title] = {"filter": sheet.auto_filter.ref, "tables": dict(sheet.tables.items()),
                               "height": sheet.max_row, "charts": len(sheet._charts)}
        continue
    sheets[sheet.title] = {
        "rows": [[cell.value for cell in row] for row in sheet.iter_rows()],
        "values": [[cell.value for cell in row] for row in values[sheet.title].iter_rows()],
        "types": [[cell.data_type for cell in row] for row in sheet.iter_rows()],
        "fills": [cell.fill.fgColor.rgb if cell.fill.fill_type else None for cell in sheet[sheet.max_row]],
        "formats": [cell.number_format for cell in sheet[sheet.max_row]],
        "print": {"rows": sheet.print_title_rows, "columns": sheet.print_title_cols, "foot": sheet.oddFooter.left.text,
                  "pages": sheet.oddFooter.right.text, "across": sheet.page_setup.fitToWidth,
                  "orientation": sheet.page_setup.orientation, "area": sheet.print_area},
        "widths": {name: column.width for name, column in sheet.column_dimensions.items()},
        "frozen": sheet.freeze_panes,
        "filter": sheet.auto_filter.ref,
        "tables": dict(sheet.tables.items()),
        "charts": [chart_of(chart) for chart in sheet._charts],
    }
json.dump({"active": book.active.title, "created": str(book.properties.created), "sheets": sheets,
           "order": book.sheetnames}, sys.stdout, default=str)
