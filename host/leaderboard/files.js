// The result files.

function renderFiles() {
  const words = (name, value) => ({name, value});
  const setWords = ({set}) => set ? [set.name, set.part, is(set.seed) ? 'seed ' + set.seed : ''].filter(Boolean).join(' ') : null;
  sortedTable(
      byId('files-table'),
      [
        words('file', (file) => file.file),
        words('set', setWords),
        {
          name: 'hash',
          value: (file) => (file.set ? file.set.hash : null),
          cell: (file) => file.set ? element('span', {class: 'hash', title: file.set.hash}, file.set.hash.slice(0, 12)) : '–'
        },
        words('gloam', (file) => file.gloam),
        words('commit', (file) => file.commit),
        words('measured', (file) => file.date),
        {name: 'rows', number: true, value: (file) => file.rows},
        {name: 'submitted', number: true, value: (file) => file.submitted || null},
        {name: 'rounds', number: true, value: (file) => file.rounds},
        words('device', (file) => file.device),
        words('driver', (file) => file.driver),
        words('CPU', (file) => file.cpu),
      ],
      data.files);
}
