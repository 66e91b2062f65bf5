"""Tables in the documents."""


def put_into(page, mark, lines):
    """Puts lines between <!-- mark --> and the next <!-- end --> of a Markdown file."""
    before, rest = page.read_text().split(f"<!-- {mark} -->\n", 1)
    after = rest.split("<!-- end -->", 1)[1]
    page.write_text(before + f"<!-- {mark} -->\n" + "\n".join(lines) + "\n<!-- end -->" + after)
