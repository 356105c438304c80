#!/usr/bin/awk -f
# Makes lines of a /// comment that are set in, which are formulas and examples, blocks of code for Doxygen. Lines that go on with
# an item of a list are set in, too, and stay.
{
  if (!match($0, /^[ \t]*\/\/\//) || substr($0, RLENGTH + 1, 1) == "<") {
    in_list = in_block = 0
    print
    next
  }
  head = substr($0, 1, RLENGTH)
  text = substr($0, RLENGTH + 1)
  if (text ~ /^ *([-*]|[0-9]+\.) /) {
    in_list = 1
  } else if (text !~ /^   /) {
    in_list = 0
  } else if (!in_list) {
    if (!in_block) print head
    in_block = 1
    print head "    " text
    next
  }
  if (in_block && text !~ /^ *$/) {
    print head
    in_block = 0
  }
  print
}
