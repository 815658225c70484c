//! The imports of each source file of a crate from the others.
//!
//! A file's arrows are all paths in it that lead to another file of the same crate, in `use` and in
//! code, followed through re-exports to the file that defines what is named. No arrows are
//!
//! * `mod x;`, and `pub use` (also `pub(crate) use`): a facade hands on, it does not use;
//! * what stands under `#[cfg(test)]`;
//! * methods: a call `x.f()` names no file. What a type is, its file has to be imported for.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::path::{Path, PathBuf};
use syn::visit::{self, Visit};

/// The files of a crate and their arrows.
#[derive(Debug, Default)]
pub(crate) struct Modules {
    /// Paths of the files, from the crate's `src`.
    pub(crate) files: Vec<String>,
    /// From file to file, with the names that are taken.
    pub(crate) arrows: BTreeMap<(usize, usize), BTreeSet<String>>,
    modules: Vec<Module>,
}

#[derive(Debug, Default)]
struct Module {
    file: usize,
    parent: Option<usize>,
    children: BTreeMap<String, usize>,
    defines: HashSet<String>,
    imports: Vec<Import>,
    /// Paths in code.
    paths: Vec<Vec<String>>,
}

/// A leaf of a `use`.
#[derive(Debug, Clone)]
struct Import {
    path: Vec<String>,
    /// The name it has here, none for `*`.
    name: Option<String>,
    is_facade: bool,
}

/// Where a path leads.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Target {
    Module(usize),
    /// Something that is defined in a module.
    Definition(usize),
}

/// Reads a crate from its `lib.rs` (or `main.rs`) on.
pub(crate) fn read(root: &Path) -> Modules {
    let mut modules = Modules::default();
    let source = root.parent().expect("a file in a folder");
    modules.read_file(root, source, source, None);
    modules.draw();
    modules
}

pub(crate) fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("cfg")
            && attribute
                .meta
                .require_list()
                .is_ok_and(|list| list.tokens.to_string() == "test")
    })
}

impl Modules {
    /// Reads a file and the files of its modules; `folder` is where those stand.
    fn read_file(
        &mut self,
        file: &Path,
        folder: &Path,
        source: &Path,
        parent: Option<usize>,
    ) -> usize {
        let text = std::fs::read_to_string(file)
            .unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let syntax = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let name = file.strip_prefix(source).expect("below the source");
        self.files.push(name.display().to_string());
        let file = self.files.len() - 1;
        self.read_items(&syntax.items, file, folder, source, parent)
    }

    fn read_items(
        &mut self,
        items: &[syn::Item],
        file: usize,
        folder: &Path,
        source: &Path,
        parent: Option<usize>,
    ) -> usize {
        let this = self.modules.len();
        self.modules.push(Module {
            file,
            parent,
            ..Module::default()
        });
        let mut reader = Reader::default();
        for item in items {
            let syn::Item::Mod(module) = item else {
                reader.visit_item(item);
                continue;
            };
            if is_test(&module.attrs) {
                continue;
            }
            let name = module.ident.to_string();
            let inner = folder.join(&name);
            let child = match &module.content {
                Some((_, items)) => self.read_items(items, file, &inner, source, Some(this)),
                None => self.read_file(&file_of(folder, &name), &inner, source, Some(this)),
            };
            self.modules[this].children.insert(name, child);
        }
        let module = &mut self.modules[this];
        module.defines = reader.defines;
        module.imports = reader.imports;
        module.paths = reader.paths;
        this
    }

    fn draw(&mut self) {
        for from in 0..self.modules.len() {
            let used = self.modules[from].imports.iter();
            let used = used.filter(|import| !import.is_facade).map(|i| &i.path);
            let used: Vec<_> = used.chain(&self.modules[from].paths).cloned().collect();
            for path in used {
                let Some(Target::Definition(to)) = self.resolve(from, &path, &mut HashSet::new())
                else {
                    continue;
                };
                let ends = (self.modules[from].file, self.modules[to].file);
                if ends.0 != ends.1 {
                    let name = path.last().cloned().unwrap_or_default();
                    self.arrows.entry(ends).or_default().insert(name);
                }
            }
        }
    }

    /// Where a path leads that stands in a module; `None`: out of the crate, or to a local name.
    fn resolve(
        &self,
        from: usize,
        path: &[String],
        seen: &mut HashSet<(usize, String)>,
    ) -> Option<Target> {
        let (first, rest) = path.split_first()?;
        let mut at = match first.as_str() {
            "crate" | "$crate" => Target::Module(0),
            "self" => Target::Module(from),
            "super" => Target::Module(self.modules[from].parent?),
            name => self.look_up(from, name, seen)?,
        };
        for name in rest {
            let Target::Module(module) = at else {
                break; // a variant or an associated item of what was found
            };
            at = match name.as_str() {
                "super" => Target::Module(self.modules[module].parent?),
                "self" => at,
                "*" => Target::Definition(module),
                name => self
                    .look_up(module, name, seen)
                    .unwrap_or(Target::Definition(module)),
            };
        }
        Some(at)
    }

    /// What a name means in a module.
    fn look_up(
        &self,
        module: usize,
        name: &str,
        seen: &mut HashSet<(usize, String)>,
    ) -> Option<Target> {
        let scope = &self.modules[module];
        if let Some(child) = scope.children.get(name) {
            return Some(Target::Module(*child));
        }
        if scope.defines.contains(name) {
            return Some(Target::Definition(module));
        }
        if !seen.insert((module, name.to_owned())) {
            return None;
        }
        for import in &scope.imports {
            match &import.name {
                Some(bound) if bound == name => return self.resolve(module, &import.path, seen),
                Some(_) => {}
                None => {
                    let outer = &import.path[..import.path.len() - 1];
                    if let Some(Target::Module(other)) = self.resolve(module, outer, seen)
                        && let Some(found) = self.look_up(other, name, seen)
                    {
                        return Some(found);
                    }
                }
            }
        }
        None
    }
}

fn file_of(folder: &Path, name: &str) -> PathBuf {
    let file = folder.join(format!("{name}.rs"));
    if file.exists() {
        file
    } else {
        folder.join(name).join("mod.rs")
    }
}

/// Collects what a module defines and names.
#[derive(Default)]
struct Reader {
    defines: HashSet<String>,
    imports: Vec<Import>,
    paths: Vec<Vec<String>>,
    depth: usize,
}

impl Reader {
    fn import(&mut self, tree: &syn::UseTree, before: &[String], is_facade: bool) {
        let mut path = before.to_vec();
        let name = match tree {
            syn::UseTree::Path(step) => {
                path.push(step.ident.to_string());
                return self.import(&step.tree, &path, is_facade);
            }
            syn::UseTree::Group(group) => {
                for tree in &group.items {
                    self.import(tree, before, is_facade);
                }
                return;
            }
            syn::UseTree::Name(leaf) if leaf.ident == "self" => before.last().cloned(),
            syn::UseTree::Name(leaf) => {
                path.push(leaf.ident.to_string());
                Some(leaf.ident.to_string())
            }
            syn::UseTree::Rename(leaf) => {
                path.push(leaf.ident.to_string());
                Some(leaf.rename.to_string())
            }
            syn::UseTree::Glob(_) => {
                path.push("*".to_owned());
                None
            }
        };
        self.imports.push(Import {
            path,
            name,
            is_facade,
        });
    }

    /// Paths in the text of a macro call.
    fn tokens(&mut self, tokens: &str) {
        let text = tokens.replace(" :: ", "::");
        let is_name = |c: char| c.is_alphanumeric() || "_:$".contains(c);
        for word in text.split(|c: char| !is_name(c)) {
            if word.contains("::") {
                let path = word.split("::").map(str::to_owned).collect();
                self.paths.push(path);
            }
        }
    }
}

/// The name an item brings into its module.
fn defined(item: &syn::Item) -> Option<String> {
    let ident = match item {
        syn::Item::Const(item) => &item.ident,
        syn::Item::Enum(item) => &item.ident,
        syn::Item::Fn(item) => &item.sig.ident,
        syn::Item::Macro(item) => item.ident.as_ref()?,
        syn::Item::Static(item) => &item.ident,
        syn::Item::Struct(item) => &item.ident,
        syn::Item::Trait(item) => &item.ident,
        syn::Item::Type(item) => &item.ident,
        syn::Item::Union(item) => &item.ident,
        _ => return None,
    };
    Some(ident.to_string())
}

fn attributes(item: &syn::Item) -> &[syn::Attribute] {
    match item {
        syn::Item::Const(item) => &item.attrs,
        syn::Item::Enum(item) => &item.attrs,
        syn::Item::Fn(item) => &item.attrs,
        syn::Item::Impl(item) => &item.attrs,
        syn::Item::Static(item) => &item.attrs,
        syn::Item::Struct(item) => &item.attrs,
        syn::Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

impl<'a> Visit<'a> for Reader {
    fn visit_item(&mut self, item: &'a syn::Item) {
        if is_test(attributes(item)) {
            return;
        }
        if self.depth == 0 {
            self.defines.extend(defined(item));
        }
        self.depth += 1;
        visit::visit_item(self, item);
        self.depth -= 1;
    }

    fn visit_item_use(&mut self, item: &'a syn::ItemUse) {
        let is_facade = !matches!(item.vis, syn::Visibility::Inherited);
        self.import(&item.tree, &[], is_facade);
    }

    fn visit_impl_item_fn(&mut self, function: &'a syn::ImplItemFn) {
        if !is_test(&function.attrs) {
            visit::visit_impl_item_fn(self, function);
        }
    }

    fn visit_path(&mut self, path: &'a syn::Path) {
        if path.leading_colon.is_none() && path.segments.len() > 1 {
            let names = path.segments.iter().map(|step| step.ident.to_string());
            self.paths.push(names.collect());
        }
        visit::visit_path(self, path);
    }

    fn visit_visibility(&mut self, _: &'a syn::Visibility) {
        // `pub(in crate::x)` uses nothing
    }

    fn visit_macro(&mut self, call: &'a syn::Macro) {
        self.tokens(&call.tokens.to_string());
        visit::visit_macro(self, call);
    }
}
