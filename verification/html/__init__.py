"""Parts of a page of HTML: text, tables, figures, cover."""
