" Vim syntax of kedge's scenes (*.prm). Copy it to ~/.vim/syntax/kedge.vim and write
"   au BufRead,BufNewFile *.prm set filetype=kedge
" into ~/.vim/filetype.vim or your vimrc.
if exists("b:current_syntax")
  finish
endif
syn match   kedgeComment    "#.*$"
syn match   kedgeKeyword    "^\s*\(set\|subsection\|end\|include\)\>"
syn match   kedgeName       "\(^\s*set\s\+\)\@<=[^=#]\+\ze="
syn match   kedgeSection    "\(^\s*subsection\s\+\)\@<=[^#]\+"
syn match   kedgeNumber     "\<[-+]\?\d\+\(\.\d*\)\?\([eE][-+]\?\d\+\)\?\>"
syn keyword kedgeFunction   sin cos tan exp log ln sqrt abs min max if erf erfc pow mod floor ceil
syn keyword kedgeShape      box ball cylinder polygon stl implicit below above
syn keyword kedgeCondition  free fixed displacement velocity motion
syn keyword kedgeBoolean    true false
hi def link kedgeComment   Comment
hi def link kedgeKeyword   Statement
hi def link kedgeName      Identifier
hi def link kedgeSection   Type
hi def link kedgeNumber    Number
hi def link kedgeFunction  Function
hi def link kedgeShape     Function
hi def link kedgeCondition Special
hi def link kedgeBoolean   Boolean
let b:current_syntax = "kedge"
